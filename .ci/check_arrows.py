#!/usr/bin/env python3
"""Checks which part of Gnomon may know which (docs/contributors/conventions.md), and that no file grows too long.

usage: check_arrows.py [ROOT]       prints one line per breach; exit status 1 if there is any
       check_arrows.py --self-test  builds small trees with one breach each and expects every one to be found
"""
import re
import sys
import tempfile
from pathlib import Path

MAX_LINES = 400
PARTS = ("engine", "shaders", "systems", "include", "window", "examples", "sample_game", "bench", "tests")
CODE = {".h", ".cpp"}
COUNTED = CODE | {".glsl", ".vert", ".frag", ".geom", ".comp", ".py", ".cmake", ".sh"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
GL_CALL = re.compile(r"(?<![\w:.>])gl[A-Z]\w*\s*\(")
COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
REGISTRY = "gnomon/registry.h"

# First matching prefix decides: what a file there may include of the project's own files.
ALLOWED = (
    ("engine/", ("engine/", "gnomon/result.h", "gnomon/box.h", "gnomon/assets.h", "gnomon/window.h")),
    ("shaders/", ("shaders/", "engine/")),
    ("systems/", ("systems/", "engine/", "gnomon/", "shaders/bindings.h", "shaders/embedded.h")),
    ("include/", ("gnomon/",)),
    ("window/", ("gnomon/", "engine/")),
    ("examples/", ("gnomon/",)),
    # What looks inside Gnomon lies apart from the game, which reads the public headers alone, as an example of their use.
    ("sample_game/inside/", ("sample_game/", "systems/", "engine/", "gnomon/")),
    ("sample_game/support/built_in_scenes/", ("sample_game/", "engine/image/", "gnomon/")),  # files, made in memory
    ("sample_game/tables_main.cpp", ("sample_game/", "systems/", "gnomon/")),  # fills pages with Gnomon's own tables
    ("sample_game/", ("sample_game/", "gnomon/")),
    ("bench/", ("",)),
    ("tests/", ("",)),
)
# Headers that the build makes, and the file that it makes each of.
MADE = {"shaders/bindings.h": "shaders/common/bindings.glsl"}
# The public headers: gnomon/core.h lies in this folder.
PUBLIC = "include/"
# Gnomon::core: the list of its files. These, and all that they include, know GLM and the standard library only.
CORE_LIST, CORE_FILE = "cmake/core.cmake", re.compile(r"^  (\S+\.cpp)$", re.MULTILINE)
# All that users include: so many headers at most, in one folder, and one that includes all others.
PUBLIC_FOLDER, UMBRELLA, MOST_PUBLIC = PUBLIC + "gnomon/", PUBLIC + "gnomon/gnomon.h", 15
# The registry is read by these alone; frame.* only hands it on to them.
READS_REGISTRY = ("include/", "systems/extract/", "systems/transform/", "systems/frame", "sample_game/", "bench/", "tests/")
# Stages that must not reach the registry by any detour either, so that another ECS can take its place.
KNOWS_NO_REGISTRY = ("systems/shadow/", "systems/lighting/", "systems/embed/", "systems/lookup/", "systems/extract/snapshot.h",
                     "include/gnomon/components.h", "include/gnomon/frame.h", "include/gnomon/shadows.h", "include/gnomon/entt.h")
CALLS_GL = ("engine/gl/", "window/", "examples/", "sample_game/gui/", "bench/embed/", "tests/")
# Rooms of a folder in the order of the flow: a file may include those of its own room and of rooms before it. What lies in the
# folder itself may include all of them.
ROOMS = {
    "systems/shadow/": ("frame", "projection", "request", "culling", "fitting", "budget", "maps", "update", "passes", "exact",
                        "publish", "report"),
    "sample_game/": ("inside", "support", "game", "gui", "app"),
}
# A project of its own, built against the installed copy: its paths start in its own folder, or in the package.
STRANGER = "tests/install_consumer/"


def is_standard(name):
    return "." not in name and "/" not in name


def included(text):
    return [(mark == "<", name) for mark, name in INCLUDE.findall(text)]


def place_of(name):
    """Path of an included file of the project from its root."""
    return PUBLIC + name if name.startswith("gnomon/") else MADE.get(name, name)


def breaches_of_include(path, name, root):
    """Reasons why the file at `path` may not include the project's own `name`."""
    if not (root / place_of(name)).is_file():
        return [f"includes {name}, which is no path from the project's root"]
    found = []
    allowed = next(prefixes for part, prefixes in ALLOWED if path.startswith(part))
    if not name.startswith(allowed):
        found.append(f"may not include {name}")
    if name == REGISTRY and not path.startswith(READS_REGISTRY):
        found.append(f"may not include {name}: extraction is the only reader of the registry")
    if path.startswith("systems/lighting/") and name.startswith("systems/shadow/") and name != "systems/shadow/frame/lighting_inputs.h":
        found.append(f"may not include {name}: lighting sees of shadow only systems/shadow/frame/lighting_inputs.h")
    if path.startswith("systems/shadow/") and name.startswith("systems/lighting/"):
        found.append(f"may not include {name}: shadow does not know who lights with it")
    return found


def breaches_of_order(path, name):
    """Reasons why the file at `path` may not include `name` of a room after its own."""
    for folder, rooms in ROOMS.items():
        if not (path.startswith(folder) and name.startswith(folder)):
            continue
        own, other = path[len(folder):].split("/"), name[len(folder):].split("/")
        if len(own) == 1:
            continue
        if own[0] not in rooms:
            return [f"lies in no room of {folder}: {', '.join(rooms)}"]
        if len(other) == 1 or rooms.index(other[0]) > rooms.index(own[0]):
            return [f"may not include {name}: {own[0]} comes before it in the flow"]
    return []


def reaches(path, goal, includes):
    """The chain of includes from path to goal, or nothing."""
    chains, seen = [[path]], {path}
    while chains:
        chain = chains.pop()
        for name in includes.get(chain[-1], ()):
            if name == goal:
                return chain + [name]
            if name not in seen:
                seen.add(name)
                chains.append(chain + [name])
    return None


def breaches_of_core(root, includes, libraries):
    """Lines `path: breach` for files of Gnomon::core that reach a library beside GLM."""
    listed = root / CORE_LIST
    sources = CORE_FILE.findall(listed.read_text(encoding="utf-8")) if listed.is_file() else []
    found, chains = [], {source: [source] for source in sources}
    pending = list(sources)
    while pending:
        path = pending.pop()
        for name in libraries.get(path, ()):
            found.append(f"{path}: may not include <{name}>: Gnomon::core knows GLM only: {' -> '.join(chains[path])}")
        for name in map(place_of, includes.get(path, ())):
            if name not in chains:
                chains[name] = [*chains[path], name]
                pending.append(name)
    return found + [f"{CORE_LIST}: lists {path}, which is no file" for path in sources if not (root / path).is_file()]


def breaches_of_public(includes):
    """Lines `path: breach` for public headers that are too many, lie elsewhere, or are missing in the one that has all."""
    headers = [path for path in includes if path.startswith(PUBLIC)]
    found = [f"{path}: lies outside {PUBLIC_FOLDER}" for path in headers if Path(path).parent.as_posix() + "/" != PUBLIC_FOLDER]
    if len(headers) > MOST_PUBLIC:
        found.append(f"{PUBLIC_FOLDER}: has {len(headers)} headers, {MOST_PUBLIC} are the limit")
    return found + [f"{UMBRELLA}: lacks {path}" for path in headers
                    if path != UMBRELLA and path not in includes.get(UMBRELLA, ())]


def check(root):
    """Sorted lines `path: breach`."""
    files = sorted(p for part in PARTS for p in (root / part).rglob("*") if p.is_file() and p.suffix in COUNTED)
    found, includes, libraries = [], {}, {}
    for file in files:
        path = file.relative_to(root).as_posix()
        text = file.read_text(encoding="utf-8", errors="replace")
        breaches = []
        lines = len(text.splitlines())
        if lines > MAX_LINES:
            breaches.append(f"has {lines} lines, {MAX_LINES} are the limit")
        if file.suffix in CODE:
            own = [name for angled, name in included(text) if not angled]
            includes[path] = [place_of(name) for name in own]
            libraries[path] = [name for angled, name in included(text)
                               if angled and not is_standard(name) and not name.startswith(("glm/", "gnomon/"))]
            for name in own if not path.startswith(STRANGER) else ():
                breaches += breaches_of_include(path, name, root) + breaches_of_order(path, name)
            for angled, name in included(text):
                if angled and path.startswith(PUBLIC) and not (is_standard(name) or name.startswith("glm/")):
                    breaches.append(f"may not include <{name}>: public headers know GLM and the standard library only")
                if angled and name.startswith(PARTS) and (root / name).is_file():
                    breaches.append(f"includes <{name}> in angle brackets, which hides an arrow")
                if angled and name.startswith("epoxy/gl") and not path.startswith(CALLS_GL):
                    breaches.append(f"may not include <{name}>: only engine/gl calls OpenGL")
            calls = {call.rstrip("( ") for call in GL_CALL.findall(COMMENT.sub("", text))}
            if calls and not path.startswith(CALLS_GL):
                breaches.append(f"may not call {', '.join(sorted(calls))}: only engine/gl calls OpenGL")
        found += [f"{path}: {breach}" for breach in breaches]
    found += breaches_of_core(root, includes, libraries) + breaches_of_public(includes)
    for path in includes:
        if path.startswith(KNOWS_NO_REGISTRY):
            chain = reaches(path, place_of(REGISTRY), includes)
            if chain and len(chain) > 2:  # a direct include was reported above
                found.append(f"{path}: reaches the registry: {' -> '.join(chain)}")
    return sorted(found), len(files)


# A tree without a breach, and for each rule a file that breaks it and what must be said of it.
CLEAN = {
    "include/gnomon/registry.h": '#include <vector>\n#include "gnomon/components.h"\n',
    "include/gnomon/result.h": "#pragma once\n#include <string>\n",
    "include/gnomon/components.h": "#pragma once\n#include <cstdint>\n#include <glm/vec3.hpp>\n",
    "engine/math/aabb.h": "#pragma once\n#include <glm/vec3.hpp>\n",
    "engine/math/bvh.h": '#include "engine/math/aabb.h"\n#include "gnomon/result.h"\n',
    "engine/gl/device_gl45.cpp": "#include <epoxy/gl.h>\nvoid f() { glClear(0); }\n",
    "engine/platform/context.cpp": "#include <GLFW/glfw3.h>\n// unlike glClear(x)\nvoid g() { glfwInit(); }\n",
    "shaders/embedded.h": "#pragma once\n",
    "shaders/common/bindings.glsl": "const int kCameraBlock = 0;\n",
    "systems/extract/snapshot.h": '#include "engine/math/bvh.h"\n#include "gnomon/components.h"\n',
    "systems/extract/extract.h": '#include "gnomon/registry.h"\n#include "systems/extract/snapshot.h"\n',
    "systems/shadow/frame/lighting_inputs.h": '#include "systems/extract/snapshot.h"\n',
    "systems/shadow/fitting/fit_light.h": '#include "systems/shadow/frame/lighting_inputs.h"\n',
    "systems/shadow/fitting/local/fit_spot.cpp": '#include "systems/shadow/fitting/fit_light.h"\n',
    "systems/shadow/publish/publish_lights.h": '#include "systems/shadow/fitting/fit_light.h"\n',
    "systems/shadow/shadow_system.h": '#include "systems/shadow/publish/publish_lights.h"\n',
    "systems/lighting/lighting.cpp": '#include "shaders/bindings.h"\n#include "shaders/embedded.h"\n#include "systems/shadow/frame/lighting_inputs.h"\n',
    "cmake/core.cmake": "set(SOURCES\n  systems/core/core.cpp\n)\n",
    "include/gnomon/gnomon.h": "".join(f'#include "gnomon/{name}.h"\n' for name in ("components", "core", "registry", "result")),
    "include/gnomon/core.h": "#pragma once\n#include <glm/vec3.hpp>\n#include <span>\n",
    "systems/core/core.cpp": '#include "gnomon/core.h"\n#include "systems/shadow/fitting/fit_light.h"\n',
    "examples/core_only.cpp": "#include <gnomon/core.h>\n",
    "sample_game/main.cpp": '#include "gnomon/registry.h"\n#include "sample_game/inside/truth.h"\n',
    "sample_game/inside/truth.h": '#include "systems/extract/extract.h"\n',
    "sample_game/gui/overlay.cpp": "#include <epoxy/gl.h>\nvoid h() { glClear(0); }\n",
    "tests/install_consumer/main.cpp": '#include <gnomon/core.h>\n#include "own.h"\n',
    "tests/gl/raw_test.cpp": '#include "systems/shadow/fitting/fit_light.h"\nvoid t() { glGetError(); }\n',
}
BREACHES = (
    ("include/gnomon/light.h", '#include "engine/math/gone.h"\n', "no path from"),
    ("include/gnomon/light.h", '#include "gnomon/gone.h"\n', "no path from"),
    ("include/gnomon/light.h", '#include "engine/math/aabb.h"\n', "may not include engine/math"),
    ("include/gnomon/light.h", '#include "systems/shadow/frame/lighting_inputs.h"\n', "may not include systems/"),
    ("include/gnomon/light.h", "#include <spdlog/spdlog.h>\n", "public headers know GLM"),
    ("include/gnomon/shadows.h", '#include "systems/extract/extract.h"\n', "reaches the registry"),
    ("engine/gl/device.h", '#include "gnomon/components.h"\n', "may not include gnomon/components"),
    ("engine/gl/device.h", '#include "systems/shadow/frame/lighting_inputs.h"\n', "may not include systems/"),
    ("engine/gl/device.h", '  #  include "shaders/embedded.h"\n', "may not include shaders/"),
    ("engine/gl/device.h", '#include "shaders/bindings.h"\n', "may not include shaders/"),
    ("engine/gl/device.h", "#include <systems/extract/snapshot.h>\n", "hides an arrow"),
    ("systems/shadow/fitting/steps.h", '#include "systems/shadow/publish/publish_lights.h"\n', "comes before it"),
    ("systems/shadow/report/why.cpp", '#include "systems/shadow/shadow_system.h"\n', "comes before it"),
    ("systems/shadow/rooms/fit.cpp", '#include "systems/shadow/frame/lighting_inputs.h"\n', "in no room"),
    ("systems/shadow/culling/receiver_caster_sets.cpp", '#include "sample_game/main.cpp"\n', "may not include sample_game/"),
    ("systems/shadow/culling/receiver_caster_sets.cpp", '#include "tests/gl/raw_test.cpp"\n', "may not include tests/"),
    ("systems/shadow/culling/receiver_caster_sets.cpp", '#include "gnomon/registry.h"\n', "only reader"),
    ("systems/shadow/culling/receiver_caster_sets.cpp", '#include "systems/extract/extract.h"\n', "reaches the registry"),
    ("systems/shadow/culling/receiver_caster_sets.cpp", '#include "systems/lighting/lighting.cpp"\n', "does not know who lights"),
    ("systems/shadow/culling/receiver_caster_sets.cpp", "void f() { glDrawArrays(4, 0, 3); }\n", "may not call glDrawArrays"),
    ("systems/lighting/shade.cpp", '#include "systems/shadow/fitting/fit_light.h"\n', "only systems/shadow/frame/lighting_inputs.h"),
    ("include/gnomon/core.h", '#include "systems/extract/snapshot.h"\n', "may not include systems/"),
    ("examples/core_only.cpp", '#include "systems/extract/snapshot.h"\n', "may not include systems/"),
    ("systems/core/core.cpp", "#include <epoxy/gl.h>\n", "knows GLM only"),
    ("systems/shadow/fitting/fit_light.h", "#include <tiny_gltf.h>\n", "core.cpp -> systems/shadow/fitting/fit_light.h"),
    ("include/gnomon/core.h", "#include <GLFW/glfw3.h>\n", "knows GLM only"),
    ("cmake/core.cmake", "set(SOURCES\n  systems/core/gone.cpp\n)\n", "which is no file"),
    ("include/gnomon/gnomon.h", '#include "gnomon/core.h"\n', "lacks include/gnomon/registry.h"),
    ("include/gnomon/more/light.h", "#pragma once\n", "lies outside"),
    ("include/gnomon/", "#pragma once\n", "are the limit"),
    ("engine/platform/window.cpp", "#include <epoxy/gl.h>\n", "only engine/gl calls"),
    ("sample_game/hud.cpp", "void f() {\n    ::glEnable(1);\n    glEnable (1);\n}\n", "may not call glEnable"),
    ("sample_game/main.cpp", '#include "tests/gl/raw_test.cpp"\n', "may not include tests/"),
    ("sample_game/main.cpp", '#include "systems/extract/extract.h"\n', "may not include systems/"),
    ("sample_game/app/app.h", '#include "engine/math/aabb.h"\n', "may not include engine/"),
    ("sample_game/inside/truth.h", '#include "sample_game/gui/overlay.cpp"\n', "inside comes before it"),
    ("shaders/shadow/long.glsl", "\n" * (MAX_LINES + 1), "limit"),
    ("tests/unit/long_test.cpp", "\n" * (MAX_LINES + 1), "limit"),
)


def self_test():
    failures = []
    for path, text, want in ((None, None, None), *BREACHES):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            added = {f"{path}h{i}.h": text for i in range(MOST_PUBLIC)} if path == PUBLIC_FOLDER else {path: text} if path else {}
            for name, content in {**CLEAN, **added}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(content, encoding="utf-8")
            found, _ = check(root)
        right = not found if path is None else any(line.startswith(f"{path}: ") and want in line for line in found)
        if not right:
            failures.append(f"expected {want!r} for {path}, found {found}")
    print(*failures, f"{len(BREACHES) + 1} trees checked, {len(failures)} judged wrongly", sep="\n")
    return 1 if failures else 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    found, count = check(root)
    if count == 0:
        found = [f"{root}: no source files here"]
    print(*found, f"{count} files checked, {len(found)} breaches", sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
