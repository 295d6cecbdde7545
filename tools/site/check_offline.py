#!/usr/bin/env python3
"""check_offline.py FOLDER: fails where a page of the site loads something from
the network: a script, a style, a font or a picture. Links may lead there. So it
does where a file of the site that a page loads is not there."""

import html.parser
import pathlib
import re
import sys

ADDRESS = re.compile(r"(https?:)?//")
# Of <link> these are only told to machines, not loaded.
NOT_LOADED = {"canonical", "next", "prev", "alternate"}


class Sources(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        loaded = [given.get("src")]
        if tag == "link" and given.get("rel") not in NOT_LOADED:
            loaded.append(given.get("href"))
        self.found += [x for x in loaded if x]


def there(folder, page, address):
    """Addresses that begin with / are those of 404.html, which servers send."""
    if page.name == "404.html":
        return (folder / address.lstrip("/")).exists()
    return (page.parent / address).exists()


def main():
    folder, faults = pathlib.Path(sys.argv[1]), []
    for page in folder.rglob("*.html"):
        sources = Sources()
        sources.feed(page.read_text())
        faults += [f"{page} loads {x}" for x in sources.found
                   if not x.startswith("data:")
                   and (ADDRESS.match(x) or not there(folder, page, x))]
    for style in folder.rglob("*.css"):
        faults += [f"{style} loads {x}" for x in re.findall(
            r"(?:url\(|@import )[\"']?((?:https?:)?//[^)\"']*)", style.read_text())]
    sys.exit("\n".join(faults) if faults else 0)


if __name__ == "__main__":
    main()
