"""What users of the studio found wrong, each in a step of its own that fails where the fault is back."""
import json
import os
import re
import signal
import time

QUOTE = "document.getElementById('quote')"
GREEN = f"{QUOTE}.classList.contains('good')"
VERDICT = "document.getElementById('verdict').textContent"
NUMBER = "document.getElementById('number').textContent"
SETTLED = "!scene.busy && !scene.pending.length && !scene.next && !answers.flowing && answers.all.size > 0"
HALF = "0,0\n150,60\n300,130\n420,200\n430,420\n"
WIDTH = "(Math.max(...section.points.map((p) => p[0])) - Math.min(...section.points.map((p) => p[0])))"
TEXT = "document.getElementById('{}').textContent"


def fresh(check, example="new section"):
    """A scene of the list, in a page without a past."""
    check.value("sessionStorage.clear()")
    check.open()
    choose(check, example)


def choose(check, example):
    check.value(f"(() => {{ const s = document.getElementById('examples'); s.value = [...s.options].find((o) => o.text === '{example}').value; s.dispatchEvent(new Event('change')); }})()")
    check.wait(SETTLED, f"{example} is computed")


def import_file(check, name, content):
    check.value(f"""(() => {{ const d = new DataTransfer(), i = document.getElementById('import'); d.items.add(new File([{json.dumps(content)}], {json.dumps(name)}));
      i.files = d.files; i.dispatchEvent(new Event('change')); }})()""")


def set_key(check, key, value):
    check.value(f"change([{{key: {json.dumps(key)}, value: {json.dumps(value)}}}])")
    check.wait(SETTLED, f"{key} = {value} is computed")


def point(check, k, axis, text):
    check.value(f"section.choose({k})")
    check.write(f"document.getElementById('point_{axis}')", text)
    check.value("document.activeElement.blur()")
    check.wait(SETTLED, "a typed point is computed")


def plausible(check):
    """No green number while the size or the density is hardly what was meant; a unit that is chosen late is that of the file."""
    fresh(check)
    check.must(check.value(GREEN), "the section to begin with has no green number")
    import_file(check, "hull.csv", HALF)
    check.wait(f"{WIDTH} > 800 && {SETTLED}", "an outline in mm is read in m")
    check.must(not check.value(GREEN) and "mean density" in check.value(VERDICT), f"860 m wide, and the number says: {check.value(VERDICT)}")
    check.must("860 m wide" in check.value(TEXT.format("section_note")), "the import does not say how wide the section is")
    check.value("(() => { const u = document.getElementById('import_unit'); u.value = 'mm'; u.dispatchEvent(new Event('change')); })()")
    check.wait(f"Math.abs({WIDTH} - 0.86) < 1e-9 && {SETTLED}", "the unit that is chosen afterwards holds for the outline")
    check.must("mean density" not in check.value(VERDICT), "the warning stays")
    set_key(check, "body.mass", "1e9")
    check.must(not check.value(GREEN) and "mean density" in check.value(VERDICT), "1e9 kg/m has a green number")
    check.must(check.value("document.getElementById('section_note').textContent") == "", "the note of the import outlives other edits")
    check.value("(() => { const u = document.getElementById('import_unit'); u.value = ''; })()")
    check.complaints("plausible")


def imports(check):
    """A file that cannot be read says so at its button, in view, and at the number."""
    fresh(check)
    import_file(check, "bad.csv", "0,0\n150,60\n300,abc\n")
    check.wait(f"{TEXT.format('import_error')}.includes('bad.csv')", "a wrong file has a message")
    box = check.value("(() => { const b = document.getElementById('import_error').getBoundingClientRect(); return [b.top, b.bottom, window.innerHeight]; })()")
    check.must(0 <= box[0] and box[1] <= box[2], f"the message is out of view: {box}")
    gap = check.value("document.getElementById('import_error').getBoundingClientRect().top - document.getElementById('import_unit').getBoundingClientRect().bottom")
    check.must(0 <= gap < 40, f"the message is {gap} pixels from its button")
    check.must(not check.value(GREEN) and "not read" in check.value(VERDICT), "the number is green though the file was not read")
    check.complaints("imports")


def typed(check):
    """A typed point is kept as typed, its other coordinate too; units are understood, other texts refused at the box."""
    fresh(check)
    other = check.value("section.points[3][0]")
    point(check, 3, "y", "0.1575437")
    check.must(check.value("section.points[3]") == [other, 0.1575437], f"0.1575437 became {check.value('section.points[3]')}")
    point(check, 3, "y", "158 mm")
    check.must(check.value("section.points[3][1]") == 0.158 and check.value("document.getElementById('point_y').value") == "0.158", "158 mm is not 0.158 m")
    for wrong in ("0,158", "2 kg", "much"):
        point(check, 3, "y", wrong)
        check.must(check.value("section.points[3][1]") == 0.158 and "Expected" in check.value(TEXT.format("point_error")), f"{wrong} in a point is not refused")
    check.must(check.value("document.getElementById('point_y').getAttribute('aria-invalid')") == "true", "the box is not marked")
    check.value("section.replace([[0, 0.00012345678], [10.123456789, 3.333], [10.123456789, 5], [-10.123456789, 5], [-10.123456789, 3.333]])")
    check.wait(f"section.points.length === 5 && {SETTLED}", "a wide section")
    point(check, 1, "y", "3.3339")
    check.must(check.value("section.points[1]") == [10.123456789, 3.3339] and check.value("section.points[0][1]") == 0.00012345678, "coordinates that were not touched are rounded")
    # velocity, as mass
    down = "document.querySelector('[data-key=\"body.velocity\"] .one:nth-of-type(2) input[type=text]')"
    error = "document.querySelector('[data-key=\"body.velocity\"] .error').textContent"
    check.write(down, "-450 cm/s")
    check.wait(f"fields.resolved['body.velocity'].includes('-4.5') && {SETTLED}", "a speed with a unit is understood")
    check.must(check.value(error) == "" and check.value(f"{down}.value") == "-450 cm/s", "a speed with a unit has an error")
    check.write(down, "-4,5")
    check.wait(f"{error}.includes('decimal point')", "a decimal comma is refused at the speed")
    check.write(down, "-.5")
    check.wait(f"{error} === '' && {SETTLED}", "-.5 is a number")
    check.write("document.querySelector('[data-key=\"body.mass\"] input')", "120,5")
    check.wait("document.querySelector('[data-key=\"body.mass\"] .error').textContent.includes('decimal point')", "a decimal comma is refused at the mass")
    check.complaints("typed")


def dragged(check):
    """Place and scale of the drawing stay while a point is dragged, the lowest and the widest too."""
    fresh(check)
    check.value("document.querySelector('[data-point=\"1\"]').scrollIntoView({block: 'center'})")
    frame = "(() => { const b = document.querySelector('#section svg').getBoundingClientRect(), p = document.querySelector('[data-point=\"12\"]').getBoundingClientRect(), q = document.querySelector('[data-point=\"8\"]').getBoundingClientRect(); return [b.top, b.height, q.left, q.top].map(Math.round); })()"
    check.value("document.getElementById('mirror').click()")
    for k, dx, dy in ((0, 0, 60), (5, 90, 0)):
        x, y = check.place(f"document.querySelector('[data-point=\"{k}\"]')")
        before, mouse = check.value(frame), check.browser.mouse
        mouse("mouseMoved", x, y)
        mouse("mousePressed", x, y, button="left", clickCount=1)
        for i in range(1, 9):
            mouse("mouseMoved", x + dx * i / 8, y + dy * i / 8, button="left")
            check.wait(SETTLED, "a step of a drag is computed")
            check.must(check.value(frame) == before, f"the drawing moves during a drag: {check.value(frame)}, was {before}")
            check.must(max(abs(a - b) for a, b in zip(check.value(f"(() => {{ const b = document.querySelector('[data-point=\"{k}\"]').getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; }})()"),
                                                       (x + dx * i / 8, y + dy * i / 8))) < 3, "the point is not under the mouse")
        mouse("mouseReleased", x + dx, y + dy, button="left", clickCount=1)
        check.wait(SETTLED, "a drag is computed")
        check.value("document.getElementById('undo').click()")
        check.wait(SETTLED, "Undo is computed")
    check.value("document.getElementById('mirror').click()")
    check.complaints("dragged")


def gauges(check):
    """Points that are dragged, typed or pasted move a gauge by the same rule, and it is said; lists of lines are read as files are."""
    area = "document.querySelector('[data-key=\"body.points\"] textarea')"
    note = TEXT.format("section_note")
    for pasted, count in (("[[0, 0], [0.3, 0.1], [0.4, 0.2], [0.41, 0.4], [-0.41, 0.4], [-0.4, 0.2], [-0.3, 0.1]]", 7), ("0,0\n0.15,0.06\n0.3,0.13\n0.42,0.2\n0.43,0.42", 9),
                          ("0;0\n0,15;0,06\n0,3;0,13\n0,42;0,2\n0,43;0,42", 9), ("0\t0\n0.15\t0.06\n0.3\t0.13\n0.43\t0.42", 7)):
        fresh(check)
        check.value(f"(() => {{ const a = {area}; a.focus(); a.value = {json.dumps(pasted)}; a.dispatchEvent(new Event('change')); a.blur(); }})()")
        check.wait(f"section.points.length === {count} && !scene.error && {SETTLED}", f"{pasted[:20]!r} is read")
        check.must("gauge p1 was moved" in check.value(note), f"the gauge is moved in silence: {check.value(note)}")
        check.must(("one half" in check.value(note)) == (not pasted.startswith("[")), "the note does not say that a half is mirrored")
    check.value(f"(() => {{ const a = {area}; a.focus(); a.value = '0,0\\n1,zero\\n1,1'; a.dispatchEvent(new Event('change')); a.blur(); }})()")
    check.wait("document.querySelector('[data-key=\"body.points\"] .error').textContent.includes('points.csv')", "a wrong list has its message at the key")
    fresh(check)
    check.drag("document.querySelector('[data-point=\"2\"]')", 0, -14)
    check.wait(SETTLED, "a drag is computed")
    check.must("gauge p1 was moved" in check.value(note), "a drag moves the gauge in silence")
    set_key(check, "body.mass", "121")
    check.must(check.value(note) == "", "a note outlives its change")
    check.complaints("gauges")


def growing(check):
    """A largest force at the end of the time is doubted, whatever moves the body, in the table of ranges too."""
    fresh(check, "wedge_constant")
    check.must(not check.value(GREEN) and "at the end of the time" in check.value(VERDICT), f"a constant velocity: {check.value(VERDICT)}")
    check.must("±" not in check.value(NUMBER), "a force that grows has a band")
    compute(check, "similarity", "body.breadth", "")
    check.must("not resolved" in check.value(TEXT.format("grid_out")), "a table takes a force that grows for a peak")
    check.complaints("growing")


def compute(check, model, first, second):
    check.value(f"""(() => {{ const f = document.getElementById('grid'); f.model.value = '{model}'; f.key1.value = '{first}'; f.key1.dispatchEvent(new Event('change'));
      f.key2.value = '{second}'; f.key2.dispatchEvent(new Event('change')); f.requestSubmit(); }})()""")
    check.wait(f"{TEXT.format('grid_progress')}.includes('done')", "a table is computed")


def tables(check):
    """A table says when it is that of another scene or other choices; one that is refused leaves none; keys are named as the fields."""
    fresh(check)
    old = "!document.getElementById('grid_old').hidden && document.getElementById('grid_out').classList.contains('old')"
    compute(check, "wagner", "body.mass", "body.velocity[1]")
    check.must(not check.value(old), "a new table is marked")
    words = check.value("document.getElementById('grid_out').innerText + document.getElementById('grid').innerText")
    check.must("velocity y" in words and "body." not in words, "keys are not named as the fields")
    check.value("document.querySelector('#grid_out td button').click()")
    check.wait(f"{SETTLED}", "values are taken")
    check.must(not check.value(old), "the values of a cell mark its own table")
    check.value("document.getElementById('undo').click()")
    set_key(check, "body.points", "[[0, 0], [0.3, 0.1], [0.4, 0.2], [0.41, 0.4], [-0.41, 0.4], [-0.4, 0.2], [-0.3, 0.1]]")
    set_key(check, "gauges[0].at", "[0.3, 0.1]")
    check.must(check.value(old), "a table of another section is not marked")
    compute(check, "wagner", "body.mass", "")
    check.must(not check.value(old), "a new table is marked")
    check.value("(() => { const m = document.getElementById('grid').model; m.value = 'mlm'; m.dispatchEvent(new Event('input', {bubbles: true})); })()")
    check.must(check.value(old), "a table of another model is not marked")
    for change, at, what in (("f.key2.value = 'body.mass'", "grid_error2", "the first key"), ("f.key2.value = ''; f.from1.value = '80,5'", "grid_error1", "decimal point")):
        check.value(f"(() => {{ const f = document.getElementById('grid'); {change}; f.requestSubmit(); }})()")
        check.wait(f"{TEXT.format(at)}.includes('{what}')", f"{change}: a message at the field")
        check.must(check.value("!document.getElementById('grid_out').children.length && !document.getElementById('grid_progress').textContent"), "a table stays beside a mistake")
    check.value("(() => { const f = document.getElementById('grid'); f.from1.value = '-100'; f.requestSubmit(); })()")
    check.wait(f"{TEXT.format('grid_out')}.includes('Expected') || {TEXT.format('grid_out')}.includes('expected')", "a refused point says why")
    said = check.value(TEXT.format("grid_out"))
    check.must("--set" not in said and "body.mass" not in said, f"a message of the command line: {said[:200]}")
    check.complaints("tables")


def afterwards(check):
    """Insert and Delete by keyboard, Undo by Ctrl+Z and after a reload, and the name of the download."""
    fresh(check)
    points = check.value("section.points")
    check.value("document.querySelector('[data-point=\"2\"]').focus()")
    check.browser.press("Insert")
    check.browser.press("Delete")
    check.wait(SETTLED, "points are computed")
    check.must(check.value("section.points") == points, "Delete after Insert removes another point")
    before = check.value("scene.text")
    time.sleep(1.1)
    set_key(check, "body.mass", "99")
    check.value("document.activeElement.blur()")
    check.browser.press("z", code="KeyZ", modifiers=2)
    check.wait(f"scene.text === {json.dumps(before)} && {SETTLED}", "Ctrl+Z is Undo")
    time.sleep(1.1)
    set_key(check, "body.mass", "98")
    check.open()
    check.value("document.getElementById('undo').click()")
    check.wait(f"scene.text === {json.dumps(before)} && {SETTLED}", "Undo after a reload")
    file = check.value("scene.file")
    time.sleep(1.1)
    choose(check, "new wedge")
    check.must(check.value("scene.file") == "wedge.toml", "the wedge has another name")
    check.value("document.getElementById('undo').click()")
    check.wait(SETTLED, "Undo is computed")
    check.must(check.value("scene.file") == file, f"the section is saved as {check.value('scene.file')}")
    # a mistake in the text stands at the text, and a refused run is forgotten with the next change
    check.value("(() => { const t = document.getElementById('text'); document.getElementById('toml').open = true; t.focus(); t.value = t.value.replace('mass = ', 'mass = -'); t.dispatchEvent(new Event('input')); })()")
    check.wait(f"{TEXT.format('text_error')}.includes('Line')", "a mistake in the text has its line")
    gap = check.value("document.getElementById('text_error').getBoundingClientRect().top - document.getElementById('text').getBoundingClientRect().bottom")
    check.must(0 <= gap < 30, f"the message is {gap} pixels below the text")
    check.must("body.mass" not in check.value(VERDICT) and "mass" in check.value(VERDICT), f"the number says: {check.value(VERDICT)}")
    check.value("document.activeElement.blur()")
    check.value("document.getElementById('run').click()")
    check.wait(f"{TEXT.format('run_error')} !== ''", "a run of a mistake is refused")
    check.value("document.getElementById('undo').click()")
    check.wait(f"{TEXT.format('run_error')} === '' && {SETTLED}", "the message of the run goes with the mistake")
    check.complaints("afterwards")


def rows(check):
    """An answer that is being computed is marked in the table; runs are listed with mass, speed, spacing and band; shifts are small."""
    fresh(check)
    check.value("window.seen = []; window.was = answers.table; answers.table = function (...all) { was.apply(this, all); seen.push(document.getElementById('models').textContent + [...document.querySelectorAll('#models tr.old')].length); }")
    time.sleep(1.1)
    check.value("section.replace([[0, 0], [0.2, 0.15], [0.3, 0.1], [0.4, 0.4], [-0.4, 0.4], [-0.3, 0.1], [-0.2, 0.15]])")
    check.wait(SETTLED, "a hollow section is computed")
    refused = check.value("answers.all.get('boundary_element').why || ''")
    check.must(refused != "", "a hollow section is not refused")
    check.value("(() => { window.seen = []; document.getElementById('undo').click(); })()")
    check.wait(f"window.seen.length > 1 && {SETTLED}", "Undo is computed")
    shown = check.value("window.seen.slice(0, -1).join(' ')")
    check.must("being computed" in shown and refused[:20] not in shown, f"an old refusal is shown: {shown[:300]}")
    check.value("(() => { const s = document.getElementById('run_model'); s.value = 'boundary_element'; document.getElementById('run').click(); })()")
    line = "[...document.querySelectorAll('#runs li')].map((li) => li.innerText).find((text) => text.includes('120') && text.includes('completed'))"
    check.wait(f"{line} !== undefined", "a run ends")
    line = check.value(line)
    check.must(re.search(r"boundary elements: completed.*peak force .*±.*mass 120\skg/m, speed 5.00\sm/s", line or "", re.S), f"the line of a run: {line}")
    top = "document.getElementById('fields').getBoundingClientRect().top + window.scrollY"
    was = check.value(top)
    check.value("document.querySelector('[data-key=\"body.mass\"] input').focus()")
    check.must(check.value("document.getElementById('help').textContent") != "" and check.value("document.querySelector('[data-key=\"body.mass\"]').offsetHeight < 60"), "the help of a field moves fields")
    set_key(check, "body.mass", "44")
    check.must(abs(check.value(top) - was) < 2, f"fields move by {check.value(top) - was} pixels after an edit")
    check.complaints("rows")


def narrow(check):
    """A table that is cut off on a narrow page says so."""
    check.browser.open(check.address, 400, mobile=True)
    check.wait(SETTLED, "the page has its answers")
    compute(check, "wagner", "body.mass", "body.velocity[1]")
    check.must(check.value("document.getElementById('grid_out').hasAttribute('data-wide') && getComputedStyle(document.getElementById('grid_out'), '::before').content.includes('scroll')"), "a table is cut off without a mark")
    check.complaints("narrow")


def ended(studio):
    """The last step: once the program has ended, the number says so and is old."""
    def ended(check):
        fresh(check)
        os.kill(studio.pid, signal.SIGKILL)
        studio.wait(30)
        check.write("document.querySelector('[data-key=\"body.mass\"] input')", "77")
        check.wait(f"{VERDICT}.includes('does not answer')", "the number says that the studio does not answer", 10)
        check.must(not check.value(GREEN) and check.value("document.getElementById('number').classList.contains('old')"), "the number is not marked")
        check.browser.events = []
    return ended


STEPS = (plausible, imports, typed, dragged, gauges, growing, tables, afterwards, rows, narrow)
