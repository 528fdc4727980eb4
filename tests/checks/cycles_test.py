"""What `cycles` finds and what it leaves out: `python3 tests/checks/cycles_test.py`."""
import importlib.machinery
import importlib.util
import os
import pathlib
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent
loader = importlib.machinery.SourceFileLoader("cycles", str(HERE / "cycles"))
cycles = importlib.util.module_from_spec(importlib.util.spec_from_loader("cycles", loader))
loader.exec_module(cycles)


def cyclic(files):
    """Modules in cycles of a crate of these files."""
    return sorted("::".join(m) for c in cycles.components(edges(files)) for m in c)


def tied(files):
    """Folders and files in cycles, each folder with all that it holds."""
    graphs = cycles.folders(edges(files)).values()
    return [sorted("::".join(m) for m in c) for graph in graphs for c in cycles.components(graph)]


def edges(files):
    before = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            file = pathlib.Path(folder, "some", "src", name)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        os.chdir(folder)
        try:
            return cycles.Crate("some").edges()
        finally:
            os.chdir(before)


class Cycles(unittest.TestCase):
    def test_use(self):
        self.assertEqual(cyclic({"lib.rs": "mod a; mod b;", "a.rs": "use crate::b::B; pub struct A;", "b.rs": "use crate::a::A; pub struct B;"}), ["a", "b"])

    def test_path_in_code(self):
        self.assertEqual(cyclic({"lib.rs": "mod a; mod b;", "a.rs": "pub fn a() { crate::b::b() }", "b.rs": "pub fn b() { super::a::a() }"}), ["a", "b"])

    def test_through_a_reexport(self):
        files = {"lib.rs": "mod a; mod b; pub use a::A;", "a.rs": "use crate::b::B; pub struct A;", "b.rs": "use crate::A; pub struct B;"}
        self.assertEqual(cyclic(files), ["a", "b"])

    def test_through_a_glob(self):
        files = {"lib.rs": "mod a; mod b;", "a.rs": "use crate::b::*; pub struct A(B);", "b.rs": "use crate::a::A; pub struct B;"}
        self.assertEqual(cyclic(files), ["a", "b"])

    def test_child_that_needs_its_parent(self):
        files = {"lib.rs": "mod a;", "a/mod.rs": "mod c; pub struct A; pub fn go() { c::run() }", "a/c.rs": "use super::A; pub fn run() {}"}
        self.assertEqual(cyclic(files), ["a", "a::c"])

    def test_items_of_the_root(self):
        files = {"lib.rs": "mod a; pub struct Root; pub fn go() { a::run() }", "a.rs": "use crate::Root; pub fn run() {}"}
        self.assertEqual(cyclic(files), ["", "a"])

    def test_parent_that_declares_and_reexports(self):
        files = {"lib.rs": "mod a;", "a/mod.rs": "mod b; mod c; pub use b::B; pub use c::C;", "a/b.rs": "pub struct B;", "a/c.rs": "use super::B; pub struct C;"}
        self.assertEqual(cyclic(files), [])

    def test_tests_comments_and_strings(self):
        a = '// crate::b::b()\npub fn a() { "crate::b::b()"; }\n#[cfg(test)]\nmod tests { use crate::b::b; }\n#[cfg(test)]\nuse crate::b::b;'
        self.assertEqual(cyclic({"lib.rs": "mod a; mod b;", "a.rs": a, "b.rs": "pub fn b() { crate::a::a() }"}), [])

    def test_test_module_in_a_file_of_its_own(self):
        files = {"lib.rs": "mod a;\n#[cfg(test)]\nmod checks;", "a.rs": "pub fn a() {}", "checks.rs": "use crate::a::a;"}
        self.assertEqual(cyclic(files), [])

    def test_path_through_an_imported_module(self):
        files = {"lib.rs": "mod a; mod b;", "a.rs": "use crate::b;\npub struct A; pub fn go() { b::run() }", "b.rs": "use crate::a::A; pub fn run() {}"}
        self.assertEqual(cyclic(files), ["a", "b"])

    def test_item_with_the_name_of_its_module(self):
        files = {"lib.rs": "mod a; mod b;", "a.rs": "use crate::b::c;\npub struct A; pub fn go() { c() }", "b/mod.rs": "pub mod c; pub use c::c;", "b/c.rs": "use crate::a::A; pub fn c() {}"}
        self.assertEqual(cyclic(files), ["a", "b::c"])

    def test_folders_that_need_each_other(self):
        files = {"lib.rs": "mod a; mod b;", "a/mod.rs": "mod x; mod y;", "a/x.rs": "use crate::b::Z;", "a/y.rs": "pub struct Y;", "b.rs": "use crate::a::y::Y; pub struct Z;"}
        self.assertEqual(cyclic(files), [])
        self.assertEqual(tied(files), [["a", "b"]])


if __name__ == "__main__":
    unittest.main()
