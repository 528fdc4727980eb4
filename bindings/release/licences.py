"""The licences of all dependencies in one text, from `cargo metadata` and the packages in the registry.

    python3 licences.py [TARGET] > THIRD-PARTY-LICENCES.txt

Dependencies are those that are linked into the command or the Python package for TARGET. A licence text that several packages share is
printed once. Of a package without the text of its licence its expression, authors and source are named; the texts of other packages have
the wording. It ends with an error where a package states no licence, or none that a program under MIT or Apache-2.0 may hold.
"""

import collections
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ["scenarios", "splashdown_python"]
NAMES = re.compile(r"(?i)^(licen[cs]e|copying|copyright|notice|unlicense)([-._].*)?$")
SOURCE = {".rs", ".py", ".toml", ".c", ".h"}
# one of each alternative must be among these
ACCEPTED = {
    "MIT", "MIT-0", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "BSD-1-Clause", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0", "CC0-1.0",
    "ISC", "MPL-2.0", "NCSA", "Unicode-3.0", "Unlicense", "Zlib", "0BSD",
}


def metadata(target):
    command = ["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform", target]
    return json.loads(subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, check=True).stdout)


def linked(data):
    """Packages that the programs are linked with, by name and version."""
    packages = {package["id"]: package for package in data["packages"]}
    nodes = {node["id"]: node for node in data["resolve"]["nodes"]}
    waiting = [i for i in data["workspace_members"] if packages[i]["name"] in PROGRAMS]
    seen = set(waiting)
    while waiting:
        for dependency in nodes[waiting.pop()]["deps"]:
            is_macro = any("proc-macro" in target["kind"] for target in packages[dependency["pkg"]]["targets"])
            is_normal = any(kind["kind"] is None for kind in dependency["dep_kinds"])
            if is_normal and not is_macro and dependency["pkg"] not in seen:
                seen.add(dependency["pkg"])
                waiting.append(dependency["pkg"])
    others = [packages[i] for i in seen - set(data["workspace_members"])]
    return sorted(others, key=lambda package: (package["name"], package["version"]))


def is_accepted(expression):
    """Whether an SPDX expression has an alternative of accepted licences."""
    text = expression.replace("/", " OR ")
    while match := re.search(r"\(([^()]*)\)", text):
        text = text[: match.start()] + ("MIT" if is_accepted(match.group(1)) else "refused") + text[match.end() :]
    return any(all(one.strip() in ACCEPTED for one in part.split(" AND ")) for part in text.split(" OR "))


def texts(folder):
    """Licence texts of a package, also of the C sources in a folder of it, by file."""
    files = [file for pattern in ("*", "*/*") for file in folder.glob(pattern)]
    files += [file for place in ("LICENSES", "licenses") for file in folder.glob(f"{place}/*")]
    files = {file for file in files if (NAMES.match(file.name) or file.parent.name.lower() == "licenses") and file.is_file()}
    files = sorted(file for file in files if file.suffix not in SOURCE)
    return {str(file.relative_to(folder)): clean(file.read_text(encoding="utf-8", errors="replace")) for file in files}


def clean(text):
    return "\n".join(line.rstrip() for line in text.replace("\r\n", "\n").strip().split("\n"))


def standard_library():
    """Licences of Rust's own library, from the compiler's folder."""
    root = subprocess.run(["rustc", "--print", "sysroot"], cwd=ROOT, stdout=subprocess.PIPE, check=True, text=True).stdout.strip()
    folder = pathlib.Path(root, "share/doc/rust")
    found = {name: clean((folder / name).read_text()) for name in ("LICENSE-MIT", "LICENSE-APACHE") if (folder / name).is_file()}
    version = subprocess.run(["rustc", "--version"], cwd=ROOT, stdout=subprocess.PIPE, check=True, text=True).stdout.split()[1]
    return f"Rust standard library {version}", "MIT OR Apache-2.0", "https://github.com/rust-lang/rust", found


def entry(package):
    expression = package["license"] or ""
    if not is_accepted(expression):
        sys.exit(f"{package['name']} {package['version']}: licence {expression or 'not stated'!r}: expected one of {sorted(ACCEPTED)}")
    found = texts(pathlib.Path(package["manifest_path"]).parent)
    source = package["repository"] or f"https://crates.io/crates/{package['name']}"
    if not found and package["authors"]:
        source += "\n    by " + ", ".join(package["authors"])
    return f"{package['name']} {package['version']}", expression, source, found


def main():
    target = sys.argv[1] if len(sys.argv) > 1 else "x86_64-unknown-linux-gnu"
    entries = [standard_library(), *map(entry, linked(metadata(target)))]
    users = collections.defaultdict(list)
    print("Licences of what is linked into splashdown\n")
    for name, expression, source, found in entries:
        print(f"{name}\n    {expression}\n    {source}")
        if not found:
            print("    the package has no licence file")
        for file, text in found.items():
            users[text].append(f"{name}: {file}")
    for text, files in users.items():
        print("\n" + "=" * 100 + "\n" + "\n".join(files) + "\n" + "-" * 100 + "\n" + text)
    without = sum(not found for *_, found in entries)
    print(f"licences: {len(entries)} packages, {len(users)} texts, {without} packages without a text", file=sys.stderr)


if __name__ == "__main__":
    main()
