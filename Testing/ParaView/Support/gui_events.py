"""The events that TestGui.py has ParaView's client play, as its test recorder writes them: what a user clicks
and types, and after it the checks of gui_session.py."""

from xml.sax.saxutils import quoteattr

MAIN = "pqClientMainWindow"
PANEL = MAIN + "/propertiesDock/propertiesPanel"
PROPERTIES = PANEL + "/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents"
DISPLAY = PROPERTIES + "/DisplayFrame/ProxyPanel/"
VIEW = PROPERTIES + "/ViewFrame/ProxyPanel/"
REPRESENTATION = MAIN + "/representationToolbar/displayRepresentation/comboBox"
FRAME = (MAIN + "/centralwidget/MultiViewWidget/CoreWidget/qt_tabwidget_stackedwidget/MultiViewWidget1"
         "/Container/Frame.0/")
WINDOW = FRAME + "CentralWidgetFrame/Viewport/1QVTKOpenGLNativeWidget0"
ARRAYS = (MAIN + "/informationDock/informationWidgetFrame/informationScrollArea/qt_scrollarea_viewport"
          "/informationWidget/dataArraysTable")
LIGHTS = MAIN + "/lightInspectorDock/lightInspectorPanel/"


def event(name, command, arguments=""):
    return f'<pqevent object={quoteattr(name)} command="{command}" arguments={quoteattr(arguments)}/>'


def shown(name, property_, text):
    return (f'<pqcheck object={quoteattr(name)} property="{property_}" '
            f'arguments={quoteattr(text).replace(chr(10), "&#xA;")}/>')


def wait(milliseconds):
    return event(MAIN, "pause", str(milliseconds))


def python(text):
    return event(MAIN + "/pythonShellDock/pythonShell/consoleWidget", "executeCommand", text)


def check(name, *arguments):
    return python(f"gui_session.run{(name, *arguments)}")


def choose(widget, text):
    return event(widget, "activated", text)


def number(widget, text):
    return event(widget, "set_string", text)


def tick(widget, on):
    return event(widget, "set_boolean", "true" if on else "false")


UNDO = event(MAIN + "/MainControlsToolbar/actionUndo", "activate")
REDO = event(MAIN + "/MainControlsToolbar/actionRedo", "activate")


representation = [
    check("make_scene"),
    check("select", "Ground"),
    shown(REPRESENTATION, "currentText", "SVO"),
    check("window", "window"),
    check("remember", "both"),
    check("watch", "Ground", "Representation"),
    choose(REPRESENTATION, "Surface"),
    UNDO,
    shown(REPRESENTATION, "currentText", "SVO"),
    REDO,
    shown(REPRESENTATION, "currentText", "Surface"),
    UNDO,
    check("watched", ("SVO", 2), ("Surface", 1), ("SVO", 2), ("Surface", 1), ("SVO", 2)),
    check("looks_like", "both"),
]

ERROR = DISPLAY + "SVOSurfacePixelError/DoubleRangeWidget/DoubleLineEdit"
surface = [
    event(PANEL + "/SearchBox/SearchLineEdit", "set_string", "SVO"),
    check("select", "Colored"),
    wait(500),
    check("window", "panel-surface"),
    check("change", "Octrees", "LeafGeometry", "Voxel"),
    check("remember", "voxels"),
    check("watch", "Colored", "SVOSurfacePixelError"),
    shown(ERROR, "text", "-1"),
    number(ERROR, "20"),
    UNDO,
    shown(ERROR, "text", "-1"),
    REDO,
    shown(ERROR, "text", "20"),
    check("watched", (-1.0, 2), (20.0, 2), (-1.0, 2), (20.0, 2)),
    check("differs_from", "voxels", 0.002),
    number(ERROR, "-1"),
    check("looks_like", "voxels"),
    number(VIEW + "SVOPixelError/DoubleRangeWidget/DoubleLineEdit", "20"),
    check("differs_from", "voxels", 0.002),
    number(VIEW + "SVOPixelError/DoubleRangeWidget/DoubleLineEdit", "1"),
    check("looks_like", "voxels"),
    check("change", "Octrees", "LeafGeometry", "Automatic"),
    check("looks_like", "both"),
    tick(DISPLAY + "SVOCastShadows/CheckBox", False),
    check("differs_from", "both", 0.003),
    tick(DISPLAY + "SVOCastShadows/CheckBox", True),
    check("looks_like", "both"),
    check("select", "Ground"),
    wait(200),
    tick(DISPLAY + "SVOReceiveShadows/CheckBox", False),
    check("differs_from", "both", 0.003),
    tick(DISPLAY + "SVOReceiveShadows/CheckBox", True),
    check("looks_like", "both"),
    check("builds", "Ground", 1),
    choose(DISPLAY + "SVOLeafGeometry/ComboBox", "Voxel"),
    check("builds", "Ground", 2),
    number(DISPLAY + "SVOMaximumLevel/IntRangeWidget/LineEdit", "5"),
    check("builds", "Ground", 3),
    check("differs_from", "both", 0.001),
    choose(DISPLAY + "SVOLeafGeometry/ComboBox", "Automatic"),
    number(DISPLAY + "SVOMaximumLevel/IntRangeWidget/LineEdit", "10"),
    check("looks_like", "both"),
    check("builds", "Ground", 3),  # kept from before
]

view = [
    choose(VIEW + "SVOShadowTechnique/ComboBox", "None"),
    check("view_has", "SVOShadowTechnique", "None"),
    check("differs_from", "both", 0.003),
    choose(VIEW + "SVOShadowTechnique/ComboBox", "Shadow Rays"),
    check("looks_like", "both", 0.002),
    choose(VIEW + "SVOShadowTechnique/ComboBox", "Shadow Buffer"),
    check("looks_like", "both"),
    number(VIEW + "SVOShadowIntensity/DoubleRangeWidget/DoubleLineEdit", "0.5"),
    check("differs_from", "both", 0.003),
    number(VIEW + "SVOShadowIntensity/DoubleRangeWidget/DoubleLineEdit", "0.7"),
    check("looks_like", "both"),
    number(VIEW + "SVOShadowBufferResolution/IntRangeWidget/LineEdit", "16"),
    check("differs_from", "both", 0.0005),
    number(VIEW + "SVOShadowBufferResolution/IntRangeWidget/LineEdit", "2048"),
    check("looks_like", "both"),
    tick(VIEW + "SVOAntiAliasing/CheckBox", True),
    check("differs_from", "both", 0.0005),
    tick(VIEW + "SVOAntiAliasing/CheckBox", False),
    check("looks_like", "both"),
]

def hover(kind):
    """The mouse over the ball in the middle of the window, with ParaView's mode that shows a tool tip."""
    mode = FRAME + {"cell": "actionHoveringSurfaceCells", "point": "actionHoveringSurfacePoints"}[kind]
    return [tick(mode, True),
            event(WINDOW, "mouseMove", "(0.45,0.45,0,0,0)"),
            event(WINDOW, "mouseMove", "(0.501,0.502,0,0,0)"),
            wait(700),  # the tip comes after 400
            check("hovered", kind),
            shown("qtooltip_label", "visible", "true"),
            check("window", "hovered-" + kind),
            tick(mode, False)]


hovers = [
    check("select", "Colored"),
    check("traced", 2),
    *hover("cell"),
    *hover("point"),
    check("traced", 2),
    choose(REPRESENTATION, "Surface"),
    check("traced", 1),
    *hover("cell"),
    *hover("point"),
    choose(REPRESENTATION, "SVO"),
    check("looks_like", "both"),
]

information = [
    check("select", "Octrees"),
    event(MAIN + "/menubar/menu_View", "activate", "Properties"),  # which is before it
    wait(500),
    check("window", "information"),
    *[shown(ARRAYS, "modelItemData", f"{row}.0,{name}") for row, name in enumerate(
        ["SVO Build Time", "SVO Level", "SVO Memory", "SVO Voxels"], 2)],
    shown(ARRAYS, "modelItemData", "3.2,[10, 10]"),
]

CASTING = VIEW + "SVOCastingLights/SVOCastingLights"
KIT = ("Head light, headlight: casts none\nKey light, directional: casts shadows\n"
       "Fill light, directional: casts none\n" + 2 * "Back light, directional: casts none\n")
lights = [
    shown(CASTING, "plainText", KIT),
    event(PANEL + "/SearchBox/SearchLineEdit", "set_string", "SVO Cast"),
    wait(200),
    check("window", "panel-lights"),
    event(MAIN + "/menubar/menu_View", "activate", "Light Inspector"),
    tick(LIGHTS + "LightsEditor/LightKitControls/LightKit", False),
    event(LIGHTS + "addLight", "activate"),
    check("casting", 1),
    shown(CASTING, "plainText", "Light 0, directional: casts shadows\n"),
]

SESSION = [wait(500), python("import gui_session"), *representation, *surface, *view, *hovers, *lights,
           *information]

PLUGINS = MAIN + "/PluginManagerDialog/"


def load(plugin):
    """Opens the plugin manager, loads the plugin and closes it."""
    return [
        wait(500),
        event(MAIN + "/menubar/menuTools", "activate", "actionManage_Plugins"),
        event(PLUGINS + "splitter/localGroup/loadLocal", "activate"),
        event(PLUGINS + "1pqFileDialog0", "filesSelected", plugin),
        event(PLUGINS + "buttonBox/1QPushButton0", "activate"),
    ]


# The plugin came when the first view was there already: its surfaces have shadows, but only the
# next session's view has settings.
LATE = [
    python("import gui_session"),
    check("make_scene"),
    shown(REPRESENTATION, "currentText", "SVO"),
    check("view_lacks", "SVOShadowTechnique"),
    check("remember", "late"),
    tick(DISPLAY + "SVOReceiveShadows/CheckBox", False),
    check("differs_from", "late", 0.003),
    tick(DISPLAY + "SVOReceiveShadows/CheckBox", True),
    check("looks_like", "late"),
    event(MAIN + "/menubar/menu_Edit", "activate", "actionDelete_All"),  # resets the session
    wait(500),
    python("import gui_session"),
    check("make_scene"),
    check("traced", 2),
    check("view_has", "SVOShadowTechnique", "Shadow Buffer"),
    shown(CASTING, "plainText", KIT),
]


# Surfaces that are no meshes: shown as SVO from the beginning, without a message.
SOURCES = [
    python("import gui_session"),
    check("make_sources"),
    wait(500),
    shown(REPRESENTATION, "currentText", "SVO"),
    check("traced", 2),
    check("window", "sources"),
    check("select", "Function"),
    wait(500),
    shown(REPRESENTATION, "currentText", "SVO"),
    check("window", "sources-function"),
]


def write(path, events):
    with open(path, "w") as file:
        file.write('<?xml version="1.0" ?>\n<pqevents>\n' + "\n".join(events) + "\n</pqevents>\n")


def number_of_checks(events):
    return sum("gui_session.run" in text for text in events)
