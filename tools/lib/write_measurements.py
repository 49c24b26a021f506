"""write_measurements.py FORM LOAD RESULTS OUT: writes the tables of docs/measurements.md from what tools/measure has run.

FORM is full or quick, LOAD the load average before the first measurement. RESULTS holds a folder for each measurement, with `command` and `results.json`.
"""
import datetime
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What decides the figures: a later commit that changes only texts or tests has the same.
PROGRAM = ["engine", "game", "shaders", "cmake", "content/flythroughs", "tools/bench", "tools/content", "tools/tarn",
           ":!*.md"]


def git(*words):
    result = subprocess.run(["git", "-c", "safe.directory=*", "-C", str(ROOT), *words], capture_output=True, text=True)
    return result.stdout.strip()


def name_commit():
    commit = git("log", "-1", "--format=%h", "--", *PROGRAM) or "unknown"
    return commit + (" with local changes" if git("status", "--porcelain", "--", *PROGRAM) else "")


def number(value, digits=3):
    """Three significant digits, without an exponent where that is readable."""
    if value == 0:
        return "0"
    if not 1e-4 <= abs(value) < 1e6:
        return f"{value:.{digits - 1}e}"
    text = f"{float(f'{value:.{digits}g}'):f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def interval(estimate, digits=3):
    low, high = number(estimate["low"], digits), number(estimate["high"], digits)
    return f"{number(estimate['mean'], digits)} ({low} .. {high})"


def fixed(estimate, decimals):
    return f"{estimate['mean']:.{decimals}f} ({estimate['low']:.{decimals}f} .. {estimate['high']:.{decimals}f})"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def write_floors(results):
    rows = [[f"`{p['name']}`", number(p["ms_median"]), number(p["floor_ms_median"]), p["floor"]]
            for p in results["passes"]]
    text = ("Median times. The floor is the least that this machine could need for the pass: bare Embree with the same "
            "rays, a bare raster of the same triangles, an empty pass, or a copy of the bytes it touches.\n\n")
    return text + table(["pass", "ms", "floor [ms]", "floor"], rows)


def bias_row(scene, method):
    cell = next(c for c in method["cells"] if c["kind"] == "first")
    bias = cell["relative_bias"]
    return [f"`{scene['name']}`", f"`{method['label']}`", fixed(cell["errors"]["mean_ratio"], 3),
            f"{1e3 * bias['low']:.2g} .. {1e3 * bias['high']:.2g}", number(1e3 * bias["variance"]),
            number(cell["ms"]["median"])]


def write_bias(results):
    text = ("One frame after the warm-up. Energy: mean of the picture over that of the reference. Squared bias and "
            "variance are relative to the reference squared; relMSE is their sum. In brackets and for the bias: 95 % "
            "intervals.\n\n")
    rows = [bias_row(s, m) for s in results["scenes"] for m in s["methods"]]
    return text + table(["scene", "method", "energy", "bias² [10⁻³]", "variance [10⁻³]", "ms a frame"], rows)


def write_equal_time(results):
    text = ("One frame of about the budget. The ratio is the method's relMSE over that of the method with the least "
            "(95 % interval). With few seeds a single firefly decides it: the last column leaves out the worst 0.1 % of "
            "the pixels. A method that is too slow for the budget renders fewer pixels and enlarges the picture (the "
            "third column is the share of width and height); such cells, and those more than a quarter off the budget, are not "
            "compared.\n\n")
    rows = []
    for scene in results["scenes"]:
        cells = {m["label"]: c for m in scene["methods"] for c in m["cells"] if c["kind"] == "budget"}
        for group in scene["equal_time"]:
            for r in group["ratios"]:
                ratio = r["reason"] if r.get("reason") else "least" if r["label"] == group["best"] else interval({**r, "mean": r["ratio"]}, 2)
                cell = cells[r["label"]]
                rows.append([f"`{scene['name']}`", f"`{r['label']}`", f"{100 * cell['resolution']:.0f} %", number(r["ms"]),
                             number(r["rel_mse"]), ratio, number(cell["errors"]["rel_mse_trimmed"]["mean"])])
    return text + table(["scene", "method", "resolution", "ms", "relMSE", "ratio", "relMSE, trimmed"], rows)


def extremes(values):
    return f"{number(min(values))} .. {number(max(values))}"


def write_flythrough(results):
    text = "Frame times over the path; errors as the range over the measured frames.\n\n"
    rows = []
    for flight in results["flythroughs"]:
        for m in flight["methods"]:
            errors = [extremes([e[key] for e in m["errors"]]) for key in ("rel_mse", "flip_ldr", "mean_ratio", "flicker")]
            rows.append([f"`{m['label']}`", number(m["frame_ms"]["median"]), number(m["frame_ms"]["p95"]), *errors])
    return text + table(["method", "ms, median", "ms, 95 %", "relMSE", "FLIP", "energy", "flicker"], rows)


def write_visibility(results):
    noise, converged = results["noise"], results["converged"]
    rows = [[m["mode"], fixed(m["rmspe"], 2), fixed(m["energy"], 4)] for m in converged["modes"]]
    return (f"With the same samples, the visibility term has {fixed(noise['variance_ratio'], 3)} times the variance when "
            "it is averaged instead of reused. Mean of many frames against the reference:\n\n"
            + table(["visibility", "RMSPE [%]", "energy"], rows) + "\n\n"
            f"Averaged less reused, same samples: {fixed(converged['averaged_minus_reuse'], 2)} points of RMSPE; with "
            f"`--per-channel` {fixed(converged['averaged_minus_reuse_per_channel'], 2)}.")


def write_options(results):
    rows = [[f"`--{o['setting']} {o['value']}`", fixed(o["energy_added_percent"], 2), fixed(o["variance_ratio"], 2)]
            for o in results["options"]]
    return "Each option alone, against none of them.\n\n" + table(
        ["option", "energy added [%]", "variance of a frame, on / off"], rows)


def write_lights(results):
    rows = [[c["lights"], number(c["update_ms"]), number(c["frame_ms"]), number(c["sum_ms"])]
            for c in results["counts"]]
    text = f"Lights of kind `{results['kind']}`, {results['moving_percent']:g} % of them moving.\n\n"
    return text + table(["lights", "update [ms]", "frame [ms]", "sum [ms]"], rows)


def write_lag(results):
    def frames(value):
        return "not seen" if value is None else value
    rows = [[s["step"], f"`{s['method']}`", frames(s["frames_to_reach"]), frames(s["frames_to_settle"])]
            for s in results["steps"]]
    text = "Frames until a method shows 90 % of a change, and until its noise is what it will stay.\n\n"
    return text + table(["change", "method", "shown after", "noise settled after"], rows)


SECTIONS = [
    ("floors", "Passes against their floors", write_floors),
    ("bias", "What each preset gets wrong", write_bias),
    ("equal_time", "What a given time buys, camera at rest", write_equal_time),
    ("equal_time_walking", "What a given time buys, camera walking", write_equal_time),
    ("flythrough", "A flight through the default scene", write_flythrough),
    ("motion", "Moving lamp, block and camera", write_flythrough),
    ("study_visibility", "Visibility: reused or averaged", write_visibility),
    ("study_options", "Options of ReSTIR", write_options),
    ("study_lights", "Cost as lights grow in number", write_lights),
    ("study_lag", "How late a change is shown", write_lag),
]


def write_head(form, load, machine):
    lines = ["# Measurements", "",
             "Written by `tools/measure" + (" --quick`" if form == "quick" else "`") + "; do not edit by hand. What each "
             "number means: [reading-errors.md](reading-errors.md).", ""]
    if form == "quick":
        lines += ["**Quick form**: tiny pictures and few seeds. It shows that the command works; do not quote its "
                  "figures.", ""]
    driver = machine["gl_renderer"] + ", Mesa " + machine["mesa"]
    lines.append(table(["what", "where and when"], [
        ["commit, the last that changed the program", name_commit()],
        ["date", datetime.date.today().isoformat()],
        ["CPU", f"{machine['cpu']}, {machine['cores']} cores, {machine['threads']} worker threads"],
        ["OpenGL driver", driver],
        ["Embree", machine["embree"]],
        ["load average before the start", f"{load} (0: an idle machine)"],
        ["`many_lights_10000.glb`", "`tarn-content many_lights --count 10000 --out many_lights_10000.glb`"]]))
    return "\n".join(lines)


def main():
    form, load = sys.argv[1:3]
    folder, out = map(pathlib.Path, sys.argv[3:5])
    parts = []
    for name, title, write in SECTIONS:
        results = json.loads((folder / name / "results.json").read_text())
        if name == "floors":
            parts.append(write_head(form, load, results["machine"]))
        command = (folder / name / "command").read_text().strip()
        parts.append(f"## {title}\n\n    {command}\n\n{write(results)}")
    out.write_text("\n\n".join(parts) + "\n")


main()
