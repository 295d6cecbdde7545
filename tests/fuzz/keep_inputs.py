#!/usr/bin/env python3
"""keep_inputs.py BUILD: what fuzzing has found, for tests to read again.

Writes damaged_files.tar.xz: of every reader the seeds, all inputs that ever
broke it (BUILD/found, and those of the archive so far whose names begin with
found_) and some of those that tools/fuzz.sh left in BUILD/corpus, none above
4 kB. The same folders give the same bytes.
"""

import io
import pathlib
import sys
import tarfile

ARCHIVE = pathlib.Path(__file__).resolve().parent / "damaged_files.tar.xz"
MOST, LARGEST = 60, 4096


def earlier():
    """{name: bytes} of what once broke a reader."""
    if not ARCHIVE.exists():
        return {}
    with tarfile.open(ARCHIVE) as archive:
        return {m.name: archive.extractfile(m).read() for m in archive
                if m.isfile() and pathlib.Path(m.name).name.startswith("found_")}


def main():
    build = pathlib.Path(sys.argv[1])
    kept = earlier()
    for seeds in sorted((build / "seeds").iterdir()):
        reader = seeds.name
        for file in seeds.iterdir():
            kept[f"{reader}/seed_{file.name}"] = file.read_bytes()
        for file in (build / "found" / reader).glob("*"):
            kept[f"{reader}/found_{file.name}"] = file.read_bytes()
        # Their names are hashes, so the first ones are any.
        small = [f for f in sorted((build / "corpus" / reader).glob("*"))
                 if f.stat().st_size <= LARGEST]
        for file in small[:MOST]:
            kept[f"{reader}/{file.name}"] = file.read_bytes()
    with tarfile.open(ARCHIVE, "w:xz", preset=9) as archive:
        for name, data in sorted(kept.items()):
            member = tarfile.TarInfo(name)
            member.size = len(data)
            archive.addfile(member, io.BytesIO(data))
    print(f"{ARCHIVE.name}: {len(kept)} files, {ARCHIVE.stat().st_size} bytes")


if __name__ == "__main__":
    main()
