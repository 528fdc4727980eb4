"""The Python of the guide runs, block after block."""

import pathlib
import re

import pytest

GUIDE = pathlib.Path(__file__).parents[3] / "docs/src/guide/python.md"


def test_the_blocks_of_the_guide_run(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```", GUIDE.read_text(encoding="utf-8"), re.M | re.S)
    assert len(blocks) >= 4
    names: dict[str, object] = {}
    for block in blocks:
        exec(compile(block, str(GUIDE), "exec"), names)
