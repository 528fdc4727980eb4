"""Reading Rust sources for the checks: code without comments, strings and test modules; modules and imports."""
import pathlib
import re

CRATES = [
    "sph_core",
    "structure_fe",
    "fsi_coupling/water_entry",
    "fsi_coupling",
    "scenarios/settings",
    "scenarios/scene",
    "scenarios/run",
    "scenarios/report",
    "scenarios/decide",
    "scenarios/studio",
    "scenarios",
    "bindings/c",
    "bindings/python",
]

_TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)"""
    r"""|(?P<raw>b?r(?P<hash>\#*)".*?"(?P=hash))"""
    r"""|(?P<string>b?"(?:\\.|[^"\\])*")"""
    r"""|(?P<char>b?'(?:\\[^\n']+|[^\\'\n])')""",
    re.S,
)


def code_only(text):
    """Code with comments removed and literals emptied; line numbers are kept."""

    def replaced(match):
        newlines = "\n" * match.group().count("\n")
        if match.group("comment"):
            return newlines
        return ("''" if match.group("char") else '""') + newlines

    return _TOKEN.sub(replaced, text)


def end_of_item(text, start):
    """Index after the item that begins at `start`: its closing brace or its semicolon."""
    depth = 0
    for index in range(start, len(text)):
        letter = text[index]
        if letter in "{[(":
            depth += 1
        elif letter in "}])":
            depth -= 1
            if depth == 0 and letter == "}":
                return index + 1
        elif letter == ";" and depth == 0:
            return index + 1
    return len(text)


def without_tests(text):
    """`code_only` text without the items under `#[cfg(test)]`, and the names of the test modules in other files."""
    test_modules = set()
    while True:
        match = re.search(r"#\[cfg\((?:test|all\(test[^\]]*)\)\]\s*(?:#\[[^\]]*\]\s*)*", text)
        if not match:
            return text, test_modules
        declared = re.match(r"(?:pub(?:\([^)]*\))?\s+)?mod\s+(\w+)\s*;", text[match.end():])
        if declared:
            test_modules.add(declared.group(1))
        text = text[: match.start()] + text[end_of_item(text, match.end()):]


def is_test(file):
    """A file of tests that a `#[path]` attribute brings in."""
    return file.stem == "tests" or file.stem.endswith("_tests")


def modules(source):
    """Modules of a crate, path of names -> code. A file is a module; `lib.rs` and `mod.rs` stand for their folder."""
    found, tests = {}, set()
    for file in sorted(pathlib.Path(source).rglob("*.rs")):
        if is_test(file):
            continue
        parts = list(file.relative_to(source).with_suffix("").parts)
        if parts[-1] in ("mod", "lib"):
            parts.pop()
        elif parts == ["main"]:
            parts = ["(binary)"]
        code, test_children = without_tests(code_only(file.read_text()))
        found[tuple(parts)] = code
        tests |= {tuple(parts) + (child,) for child in test_children}
    return {name: code for name, code in found.items() if not any(name[: len(t)] == t for t in tests)}


def split_use(tree):
    """`a::{b, c::{d as e}}` -> [("a::b", "b"), ("a::c::d", "e")]: paths with the names they bring."""
    tree = tree.strip()
    brace = tree.find("{")
    if brace < 0:
        path, _, alias = (part.strip() for part in re.sub(r"\s+as\s+", "\0", tree).partition("\0"))
        path = re.sub(r"\s", "", path)
        if path.endswith("::self"):
            path = path[: -len("::self")]
        return [(path, alias or path.split("::")[-1])]
    prefix, inner = tree[:brace], tree[brace + 1 : tree.rfind("}")]
    parts, depth, start = [], 0, 0
    for index, letter in enumerate(inner):
        depth += (letter == "{") - (letter == "}")
        if letter == "," and depth == 0:
            parts.append(inner[start:index])
            start = index + 1
    parts.append(inner[start:])
    return [found for part in parts if part.strip() for found in split_use(prefix + part.strip())]
