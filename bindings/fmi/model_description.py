"""The model description and the documentation of a unit, of what its program `describe` prints."""
import html
import xml.etree.ElementTree as xml

UNITS = {
    "m": {"m": 1}, "s": {"s": 1}, "rad": {"rad": 1}, "m/s": {"m": 1, "s": -1}, "rad/s": {"rad": 1, "s": -1},
    "N/m": {"kg": 1, "s": -2}, "N": {"kg": 1, "m": 1, "s": -2}, "J/m": {"kg": 1, "m": 1, "s": -2},
}
CATEGORIES = {
    "logStatusWarning": "Warnings about the scene",
    "logStatusDiscard": "Inputs that were refused; nothing has changed",
    "logStatusError": "Wrong calls, and steps in which the water broke down",
    "logStatusFatal": "Internal errors",
}
CONVENTION = (
    "Set the inputs before fmi3DoStep: they hold at the end of the step. Outputs of the step are means over it, so that "
    "the step times the force is the impulse; those that end in _now are of its end. Loads are per metre of span, angles "
    "are in radians, counter-clockwise. With inputs_at_start = true inputs hold at the start of the step."
)
VARIABILITY = {"input": "continuous", "output": "continuous", "parameter": "fixed"}


def add_variable(parent, described, variable):
    """A variable with its dimensions and start values."""
    kind, causality = variable["type"], variable["causality"]
    attributes = {
        "name": variable["name"],
        "valueReference": str(variable["reference"]),
        "causality": causality,
        "variability": "discrete" if causality == "output" and kind != "Float64" else VARIABILITY[causality],
        "description": variable["description"],
    }
    if variable["unit"]:
        attributes["unit"] = variable["unit"]
    if causality != "output" and kind != "String":
        start = variable["start"]
        attributes["start"] = str(bool(start[0])).lower() if kind == "Boolean" else " ".join(map(repr, start))
    element = xml.SubElement(parent, kind, attributes)
    for columns in ([described["nodes"]], [described["nodes"], 2])[: variable["columns"]][-1:]:
        for count in columns:
            xml.SubElement(element, "Dimension", start=str(count))
    if kind == "String":
        xml.SubElement(element, "Start", value="")


def model_description(described):
    """The bytes of modelDescription.xml."""
    root = xml.Element(
        "fmiModelDescription",
        fmiVersion="3.0",
        modelName=described["name"],
        instantiationToken=described["token"],
        description=f"Water under the body of the scene {described['name']}, moved by an importer. {CONVENTION}",
        version=described["version"],
        license="MIT OR Apache-2.0",
        generationTool=f"splashdown {described['version']}",
        variableNamingConvention="structured",
    )
    xml.SubElement(
        root,
        "CoSimulation",
        modelIdentifier="splashdown",
        canGetAndSetFMUState="true",
        canSerializeFMUState="true",
        canHandleVariableCommunicationStepSize="true",
        canReturnEarlyAfterIntermediateUpdate="false",
        providesIntermediateUpdate="false",
        hasEventMode="false",
        maxOutputDerivativeOrder="0",
    )
    units = xml.SubElement(root, "UnitDefinitions")
    for unit, exponents in UNITS.items():
        exponents = {base: str(exponent) for base, exponent in exponents.items()}
        xml.SubElement(xml.SubElement(units, "Unit", name=unit), "BaseUnit", exponents)
    categories = xml.SubElement(root, "LogCategories")
    for name, description in CATEGORIES.items():
        xml.SubElement(categories, "Category", name=name, description=description)
    variables, structure = xml.SubElement(root, "ModelVariables"), xml.SubElement(root, "ModelStructure")
    xml.SubElement(variables, "Float64", name="time", valueReference="0", causality="independent",
                   variability="continuous", description="Time of the importer", unit="s")
    for variable in described["variables"]:
        add_variable(variables, described, variable)
    for kind in ("Output", "InitialUnknown"):
        for variable in described["variables"]:
            if variable["causality"] == "output":
                xml.SubElement(structure, kind, valueReference=str(variable["reference"]))
    xml.indent(root)
    return xml.tostring(root, encoding="UTF-8", xml_declaration=True) + b"\n"


def documentation(described):
    """The page of the unit."""
    sizes = {0: "", 1: f"[{described['nodes']}]", 2: f"[{described['nodes']}][2]"}
    rows = "\n".join(
        f"<tr><td>{v['name']}{sizes[v['columns']]}</td><td>{v['causality']}</td><td>{v['unit']}</td>"
        f"<td>{html.escape(v['description'])}</td></tr>"
        for v in described["variables"]
    )
    name = html.escape(described["name"])
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{name}</title></head><body>
<h1>{name}: water under a body</h1>
<p>{CONVENTION}</p>
<p>A step may be rejected: fmi3GetFMUState before it, fmi3SetFMUState to return. fmi3Discard: the inputs were refused and
nothing has changed. fmi3Error in a step: the water broke down; a state that was taken before can be set.</p>
<table><tr><th>variable</th><th>causality</th><th>unit</th><th>what</th></tr>
{rows}
</table>
<p>The scene is resources/scene.toml, with the settings in resources/unit.txt.</p>
</body></html>
"""
