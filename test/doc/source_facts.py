"""What the code says about itself: topics, services, messages, commands, options, diagnostics."""

import glob
import os
import re

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# Files in examples that a user makes, or that a run writes.
FILES_OF_USERS = {"my_rover.yaml", "sensor.yaml", "RTKLIB.pos", "report.html", "tables.md", "groups.md", "default.yaml",
                  "init_params.yaml"}

# Nodelets whose publishers live in a class of their own.
PUBLISHERS = {"estimate_publisher.cpp": ["Filter"], "sensor_publisher.cpp": ["Simulator", "SimulatedRover"],
              "stop_messages.cpp": ["StopSupervisor"],
              "start_reporter.cpp": ["Initializer"]}
# diagnostic_updater publishes it for every nodelet.
DIAGNOSTICS = ("diagnostics", "diagnostic_msgs/DiagnosticArray")
PLACEHOLDER = r"%[-.\d]*l?[a-zA-Z]"
# A piece of a message that is shorter could be anything.
LEAST_PART = 3
# Types whose values have a unit.
PHYSICAL = r"(?:float64(?:\[\d*\])?|geometry_msgs/(?:Quaternion|Vector3|Point))"


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def finds(path):
    """Whether a path, maybe with stars, is a file from the top or from include/slipnav or src, or a file name there."""
    places = (path, f"include/slipnav/{path}", f"include/slipnav/**/{path}", f"src/**/{path}",
              f"scripts/**/{path}", f"test/**/{path}",
              f"launch/{path}")
    return any(glob.glob(os.path.join(ROOT, place), recursive=True) for place in places)


def nodelets():
    return set(re.findall(r'name="slipnav/(\w+)"', read("nodelet_plugins.xml")))


def messages():
    return {os.path.splitext(os.path.basename(path))[0] for path in glob.glob(os.path.join(ROOT, "[ms][sr][gv]", "*"))}


def physical_fields():
    """(path, line) of each message field that has a unit."""
    for path in sorted(glob.glob(os.path.join(ROOT, "[ms][sr][gv]", "*"))):
        for line in read(path).splitlines():
            if re.match(PHYSICAL + r" \w+", line):
                yield os.path.relpath(path, ROOT), line


def nodelet_sources():
    """(nodelet, source text) of each nodelet and of its publishers."""
    for path in glob.glob(os.path.join(ROOT, "src/nodelets/*_nodelet.cpp")):
        text = read(path)
        yield re.search(r"^/// slipnav/(\w+):", text).group(1), text
    for name, nodelets_of_file in PUBLISHERS.items():
        for nodelet in nodelets_of_file:
            yield nodelet, read(glob.glob(os.path.join(ROOT, "src/ros/*", name))[0])


def topic_names():
    """Default topic by what the code calls it: a field of TopicNames or a constant of internal_topics.h."""
    keys = dict(re.findall(r'v\.text\("([^"]+)", (\w+)', read("src/config/topics.cpp")))
    names = {f"{block}.{field}": key for key, field in keys.items() for block in ("config.topics", "topics", "topics_")}
    names.update(re.findall(r'\* (k\w+Topic) = "([^"]+)"', read("src/ros/runtime/internal_topics.h")))
    return names


def full_type(name):
    own = name if "::" in name else f"slipnav::{name}"
    return own.replace("::", "/")


def topics():
    """{topic: (type, nodelets that publish, nodelets that read)}"""
    names = topic_names()
    calls = re.compile(r"(listen|publisher|SharedPublisher)<([\w:]+)>\((?:node, )?\s*([\w.]+|\"[^\"]+\")")
    found = {}
    for nodelet, text in nodelet_sources():
        for call, kind, topic in calls.findall(text):
            name = topic.strip('"') if topic.startswith('"') else names[topic]
            entry = found.setdefault(name, (full_type(kind), set(), set()))
            if entry[0] != full_type(kind):
                raise AssertionError(f"{name} has two types")
            entry[2 if call == "listen" else 1].add(nodelet)
    found[DIAGNOSTICS[0]] = (DIAGNOSTICS[1], {"all"}, found[DIAGNOSTICS[0]][2])
    found["/clock"][1].discard("SimulatedRover")  # which goes by the time that there is
    found[names["kTuningTopic"]] = ("dynamic_reconfigure/Config", tuners(), {"all"})
    return found


def tuners():
    """Nodelets that offer parameters to dynamic_reconfigure."""
    return {nodelet for nodelet, text in nodelet_sources() if "offerTuning(" in text}


def services():
    """NODE/SERVICE, nodes named as in nodelets.launch."""
    nodes = dict(re.findall(r"\b(\w+)=slipnav/(\w+)", read("launch/nodelets.launch")))
    node_of = {nodelet: node for node, nodelet in nodes.items()}
    served = {f"{node_of[nodelet]}/{name}" for nodelet, text in nodelet_sources()
              for name in re.findall(r'serve\("(\w+)"', text)}
    return served | {f"{node_of[nodelet]}/set_parameters" for nodelet in tuners()}


def commands():
    """{command: file that does it}, of those that there are."""
    rows = re.findall(r"^(\w+)\s*\| (script|tool) (\w+)\s*\|", read("run"), flags=re.M)
    paths = {name: f"scripts/{target}" if kind == "script" else f"src/tools/{target}.cpp"
             for name, kind, target in rows}
    return {name: path for name, path in paths.items() if os.path.exists(os.path.join(ROOT, path))}


# What a script of this name only starts.
PYTHON_PROGRAMS = {"tables": "scripts/paper_tables.py", "foreign": "scripts/foreign_drives.py",
                   "import": "scripts/import_recording.py", "zoo": "scripts/zoo_campaign.py",
                   "evaluate": "scripts/evaluate_drives.py", "forecast": "scripts/plot_forecast.py",
                   "tune": "scripts/tune_drives.py", "mutate": "scripts/slipnav_mutants/__main__.py"}
# Programs that hand options on to an executable, and those of every campaign.
EXECUTABLES = {"evaluate": "src/tools/evaluate.cpp", "forecast": "src/tools/forecast.cpp",
               "tune": "src/tools/tune.cpp"}
CAMPAIGN = "scripts/slipnav_campaign/engine.py"


def options_of(command):
    """Names of its options, without dashes."""
    path = commands()[command]
    text = read(path)
    if path.endswith(".cpp"):
        return options_of_executable(text)
    if command in PYTHON_PROGRAMS:
        program = read(PYTHON_PROGRAMS[command])
        shared = read(CAMPAIGN) if "engine.add_options" in program else ""
        passed = options_of_executable(read(EXECUTABLES[command])) if command in EXECUTABLES else set()
        return set(re.findall(r'add_argument\(\s*"--([\w-]+)"', program + shared)) | {"help"} | passed
    return set(re.findall(r"--([a-z][\w-]*)", text))


def options_of_executable(text):
    declared = re.compile(r'\.(?:option|flag|choice|repeated)\("([\w-]+)"')
    shared = read("src/config/config.cpp") if "declareConfigOptions" in text else ""
    return set(declared.findall(text + shared)) | {"help"}


def literals(statement):
    """The text of a C++ statement's string literals, adjacent ones joined."""
    return [re.sub(r'"\s*"', "", text) for text in re.findall(r'"((?:[^"\\]|\\.|"\s*")*)"', statement)]


def body_of(function, text):
    """From the name of a function at its definition to the closing brace at the same indentation."""
    match = re.search(rf"^( *)[^\n]*\b{function}\([^\n]*\{{\n(.*?)^\1\}}", text, flags=re.M | re.S)
    return match.group(2)


def fixed_part(text):
    """The longest piece of a message between its placeholders."""
    parts = re.split(PLACEHOLDER, text)
    return max(parts, key=len).strip(" :;,'")


def diagnostic_texts():
    """Summaries of diagnostics, warnings and errors of the nodelets, names of alarms, progress of the start."""
    texts = set()
    for _, text in nodelet_sources():
        for statement in re.findall(r"(?:status|diagnostics)\.(?:summary|mergeSummary)\((.*?)\);", text, flags=re.S):
            texts.update(literals(statement))
        for statement in re.findall(r"NODELET_(?:WARN|ERROR)\w*\((.*?)\);", text, flags=re.S):
            texts.update(literals(statement)[:1])
    for function in ("problemOf", "dangerOf"):
        texts.update(literals(body_of(function, read("src/core/stopping/stop_verdict.cpp"))))
    texts.update(literals(body_of("failureOfImu", read("src/nodelets/ins_nodelet.cpp"))))
    texts.update(literals(body_of("troubleOf", read("src/nodelets/forecast_nodelet.cpp"))))
    texts.update(literals(body_of("problem", read("src/ros/runtime/sensor_watch.h"))))
    texts.update(literals(body_of("FitToDrive::verdict", read("src/ros/runtime/fit_to_drive.cpp"))))
    for function in ("whyNoEmergencyStop", "whyNoStop"):
        texts.update(literals(body_of(function, read("src/core/stopping/stop_reach.cpp"))))
    health = read("src/core/navigation/health.cpp")
    texts.update(text for statement in re.findall(r"note\((.*?)\);", health) for text in literals(statement))
    texts.update(literals(body_of("complaintOf", read("src/core/sensors/imu_screen.cpp"))))
    texts.update(literals(body_of("componentName", read("include/slipnav/core/ekf/engine/filter_data.h"))))
    progress = body_of("Initializer::progress", read("src/core/navigation/initializer.cpp"))
    texts.update(text for statement in re.findall(r"return (.*?);", progress) for text in literals(statement))
    texts.update(text for statement in re.findall(r"refuse\((.*?)\);", read("src/core/navigation/checkpoint.cpp"))
                 for text in literals(statement)[:1])
    return {fixed_part(text) for text in texts if len(fixed_part(text)) > 2}


def all_literals():
    """All string literals of the code, adjacent ones joined."""
    patterns = ("src/**/*.cpp", "src/**/*.h", "include/**/*.h")
    paths = [path for pattern in patterns for path in glob.glob(os.path.join(ROOT, pattern), recursive=True)]
    return {text for path in paths for text in literals(read(path))}


def is_said(message, said):
    """Whether a message, with … for what differs, can be put together from literals: no word of it is left over."""
    parts = {part.strip(" :;,'") for text in said for part in re.split(PLACEHOLDER, text)}
    rest = message
    for part in sorted(parts, key=len, reverse=True):
        if len(part) >= LEAST_PART:
            rest = rest.replace(part, " ")
    return not re.search(r"\w{2}", rest)
