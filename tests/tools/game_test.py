"""game_test.py COMPILER DIRS: the folder game/ stands on the engine's public surface alone, as a stranger's program would.

What its files include is their own, the public surface, the standard library, or one of the libraries beside it;
and DIRS, the include directories it is compiled with (separated by :), do not offer the engine's inside."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
GAME = ROOT / "game"
PUBLIC = ROOT / "engine" / "include"
INCLUDE = re.compile(r"^[ \t]*#[ \t]*include[ \t]*(.*)$", re.M)
BESIDE = re.compile(r"<(GLFW/glfw3\.h|fmt/[a-z]+\.h|imgui(_stdlib|_impl_glfw|_impl_opengl3)?\.h)>")
BULLET = re.compile(r"<(btBulletDynamicsCommon|Bullet(Collision|Dynamics)/[A-Za-z]+/bt[A-Za-z]+)\.h>")
COMMAND_LINE = "<CLI/CLI.hpp>"
STANDARD = re.compile(r"<[a-z_]+>")
INSIDE = ("core/error.h", "world/world.h", "api/scene_state.h", "shared/math/brdf.h", "engine/core/error.h",
          "tools/tarn/session.h")


def is_allowed(include, folder):
    include = include.split("//")[0].strip()
    if BESIDE.fullmatch(include) or STANDARD.fullmatch(include):
        return True
    # Physics belongs to the play, the command line to the program.
    if BULLET.fullmatch(include) or include == COMMAND_LINE:
        return folder == GAME / ("sandbox" if include == COMMAND_LINE else "play")
    if re.fullmatch(r"<tarn/[a-z]+\.h>", include):
        return (PUBLIC / include.strip("<>")).exists()
    if not re.fullmatch(r'"[a-z_./]+\.h"', include):
        return False
    file = (folder / include.strip('"')).resolve()
    return file.is_relative_to(GAME) and file.exists()


def find_trespasses(name, text, folder=GAME):
    for include in INCLUDE.findall(text):
        if not is_allowed(include, folder):
            yield f"{name}: includes {include}, which is neither public nor the game's own"


def check_files():
    files = [file for ending in ("h", "cpp") for file in GAME.rglob(f"*.{ending}")]
    if not files:
        yield "game/ has no files"
    for file in files:
        yield from find_trespasses(file.relative_to(ROOT), file.read_text(), file.parent)


def check_that_trespasses_are_found():
    planted = [f'#include "{header}"' for header in INSIDE]
    planted += ["#include <core/error.h>", "#include <glm/glm.hpp>", "#include <glad/gl.h>", "#include <tarn/nothing.h>",
                '  #  include "../engine/core/error.h"', "#include THE_ENGINE", "#include <btBulletDynamicsCommon.h>",
                "#include <CLI/CLI.hpp>", '#include "play/nothing.h"', '#include "../engine/include/tarn/scene.h"']
    for line in planted:
        if not list(find_trespasses("planted", f"// a game\n{line}\n")):
            yield f"this test does not find {line}"


def compiles(compiler, folders, header):
    """Whether a source in game/ that includes the header gets through the preprocessor."""
    command = [compiler, "-std=c++20", "-E", "-x", "c++", "-o", "/dev/null", "-"]
    command += [f"-I{folder}" for folder in folders]
    return subprocess.run(command, input=f"#include <{header}>\n", text=True, capture_output=True, cwd=GAME).returncode == 0


def check_folders(compiler, folders):
    if not compiles(compiler, folders, "tarn/tarn.h"):
        yield f"the public surface does not compile with {folders}"
    for header in INSIDE:
        if compiles(compiler, folders, header):
            yield f"game/ is compiled with folders that offer {header}: {folders}"
    if not compiles(compiler, [*folders, str(ROOT)], "engine/core/version.h"):
        yield "this test does not find that a folder offers the engine's inside"


def main():
    folders = [folder for folder in sys.argv[2].split(":") if folder]
    faults = [*check_files(), *check_that_trespasses_are_found(), *check_folders(sys.argv[1], folders)]
    print("\n".join(faults) or "all passed")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
