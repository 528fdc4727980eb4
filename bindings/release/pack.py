"""Archive and wheel of a release: files in order, times of the last commit, licences in them.

    python3 pack.py archive NAME FOLDER OUT      OUT/NAME.tar.gz with the files of FOLDER
    python3 pack.py wheel WHEEL FOLDER OUT       OUT/WHEEL with the files of FOLDER in its dist-info/licenses
"""

import base64
import gzip
import hashlib
import os
import pathlib
import re
import sys
import tarfile
import time
import uuid
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
# a zip cannot hold times before 1980
TIME = max(int(os.environ["SOURCE_DATE_EPOCH"]), 315_532_800)


def archive(name, folder, out):
    with open(out / f"{name}.tar.gz", "wb") as raw, gzip.GzipFile("", "wb", 9, raw, TIME) as packed:
        with tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as file:
            for path in sorted(path for path in folder.rglob("*") if path.is_file()):
                entry = tarfile.TarInfo(f"{name}/{path.relative_to(folder)}")
                entry.size, entry.mtime, entry.mode = path.stat().st_size, TIME, 0o755 if os.access(path, os.X_OK) else 0o644
                with path.open("rb") as content:
                    file.addfile(entry, content)


def repeatable(text):
    """A list of parts (CycloneDX) without the folder of the sources, the time and the random number of its making."""
    text = text.replace(ROOT.as_uri(), "file:///splashdown")
    text = re.sub(r'("timestamp": )"[^"]*"', rf'\1"{time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(TIME))}"', text)
    text = re.sub(r'("serialNumber": )"[^"]*"', r'\1""', text)
    return text.replace('"serialNumber": ""', f'"serialNumber": "{uuid.uuid5(uuid.NAMESPACE_URL, text).urn}"')


def wheel(given, folder, out):
    with zipfile.ZipFile(given) as file:
        content = {entry.filename: (file.read(entry), entry.external_attr) for entry in file.infolist() if not entry.is_dir()}
    (record,) = [name for name in content if name.endswith(".dist-info/RECORD")]
    place = record.removesuffix("RECORD")
    for name in content:
        if name.endswith(".cyclonedx.json"):
            content[name] = (repeatable(content[name][0].decode()).encode(), content[name][1])
    licences = sorted(path for path in folder.iterdir() if path.is_file())
    for path in licences:
        content[f"{place}licenses/{path.name}"] = (path.read_bytes(), 0o100644 << 16)
    metadata, attributes = content[f"{place}METADATA"]
    head, blank, text = metadata.decode().partition("\n\n")
    version = re.search(r"^Metadata-Version: (\d+)\.(\d+)", head)
    if version is None or tuple(map(int, version.groups())) < (2, 4):
        sys.exit(f"{given}: expected Metadata-Version 2.4 or newer, which names licence files")
    known = re.findall(r"^License-File: (.*)$", head, re.M)
    head += "".join(f"\nLicense-File: {path.name}" for path in licences if path.name not in known)
    content[f"{place}METADATA"] = ((head + blank + text).encode(), attributes)

    def line(name):
        data = content[name][0]
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        return f"{name},sha256={digest},{len(data)}\n"

    names = sorted(set(content) - {record})
    lines = "".join(map(line, names)) + f"{record},,\n"
    content[record] = (lines.encode(), content[record][1])
    # dist-info stands last, as the format asks for
    names = sorted([*names, record], key=lambda name: (name.startswith(place), name))
    with zipfile.ZipFile(out / given.name, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as file:
        for name in names:
            entry = zipfile.ZipInfo(name, time.gmtime(TIME)[:6])
            entry.compress_type, entry.external_attr, entry.create_system = zipfile.ZIP_DEFLATED, content[name][1], 3
            file.writestr(entry, content[name][0])


def main():
    kind, given, folder, out = sys.argv[1:]
    if kind == "archive":
        archive(given, pathlib.Path(folder), pathlib.Path(out))
    else:
        wheel(pathlib.Path(given), pathlib.Path(folder), pathlib.Path(out))


if __name__ == "__main__":
    main()
