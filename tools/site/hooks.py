"""What mkdocs has to be told of pages that are written for a repository."""

import pathlib
import re
import shutil

ROOT = pathlib.Path(__file__).resolve().parents[2]
FENCE = re.compile(r"^( *```)([a-z]*) [^\n]*$", re.M)
LINK = re.compile(r"\[([^\]]*)\]\(([^)#: ]+)(#[^)]*)?\)")
SHIM = "https://unpkg.com/iframe-worker/shim"  # what the theme would load
WORKER = "assets/file_worker.js"  # ours, which does the same
LISTS = {"Effects": "docs/effects", "Robots": "data"}


def title_of(path):
    return re.search(r"^# (.*)$", path.read_text(), re.M)[1]


def on_config(config):
    """The pages of folders that grow are listed here, not in mkdocs.yml."""
    for group in config.nav:
        (name, pages), = group.items()
        if name in LISTS:
            found = sorted((ROOT / LISTS[name]).rglob("*.md"),
                           key=lambda path: (path.name != "README.md"
                                             or path.parent.name == "data", path))
            pages += [{title_of(path): str(path.relative_to(ROOT))}
                      for path in found]
    return config


def on_page_markdown(markdown, page, config, files):
    """Takes out what only tests/documents.py reads behind a fence, and links to
    what the repository has but the site has not."""
    here = pathlib.PurePosixPath(page.file.src_uri).parent

    def without_link(link):
        text, target, _ = link.groups()
        there = (ROOT / here / target).resolve()
        in_site = files.get_file_from_path(
            there.relative_to(ROOT).as_posix()) if there.is_relative_to(
                ROOT) else None
        if in_site or not there.exists():
            return link[0]  # mkdocs says what does not exist
        return text

    return LINK.sub(without_link, FENCE.sub(r"\1\2", markdown))


def on_post_page(output, page, config):
    return output.replace(SHIM, "../" * page.url.count("/") + WORKER)


def on_post_template(output_content, template_name, config):
    return output_content.replace(SHIM, WORKER)


def on_post_build(config):
    shutil.copy(ROOT / "tools/site/file_worker.js",
                pathlib.Path(config.site_dir) / WORKER)
