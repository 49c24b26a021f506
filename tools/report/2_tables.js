// The tables: one row a method and budget, equal error, counts, settings, machine, comparison.
"use strict";

function describeCell(cell) {
  if (cell.kind === "first") return "one frame";
  if (cell.kind === "mean") return `mean of ${cell.frames}`;
  return `${cell.budget_ms} ms`;
}

// What was done to fill the budget: frames, or a turned dial.
function describeEffort(method, cell) {
  const dial = method.dial && cell.kind === "budget" ? `${method.dial} ${cell.settings[method.dial]}` : "";
  const resolution = cell.resolution < 1 ? `${100 * cell.resolution} % of the size, ` : "";
  const frames = cell.frames === 1 ? "1 frame" : `${cell.frames} frames`;
  return resolution + (dial && cell.frames === 1 ? dial : dial ? `${frames}, ${dial}` : frames);
}

function makeBias(bias) {
  const text = `${formatNumber(bias.low)} … ${formatNumber(bias.high)}`;
  const isBiased = bias.low > 0 && isFarFrom(0, bias.low, bias.high);
  return element("span", isBiased ? {class: "mark", title: "above 0 by more than twice the interval's reach"} : {}, text);
}

function makeMs(cell) {
  const isOff = cell.budget_ms !== null && Math.abs(cell.ms.median / cell.budget_ms - 1) > 0.25;
  return element("span", isOff ? {class: "mark", title: "more than a quarter off the budget"} : {},
    formatMs(cell.ms.median), element("span", {class: "pm"}, ` (${formatMs(cell.ms.p95)})`));
}

function makeCellLabel(method, index, cell) {
  return element("span", {title: method.sentence}, swatch(index), `${method.label}, ${describeCell(cell)}`);
}

// A row for each cell of each method.
function makeCellTable(scene, headings, describe) {
  const rows = [];
  scene.methods.forEach((method, index) => method.cells.forEach((cell, number) => {
    rows.push({group: number === 0, cells: [makeCellLabel(method, index, cell), ...describe(cell, method)]});
  }));
  return makeTable(["method", ...headings], rows);
}

function makeErrorTable(scene) {
  return makeCellTable(scene, ["ms (p95)", "relMSE", "trimmed", "FLIP", "energy", "relative bias²"], (cell) => {
    const ratio = cell.errors.mean_ratio;
    return [makeMs(cell), makeEstimate(cell.errors.rel_mse), makeEstimate(cell.errors.rel_mse_trimmed),
      makeEstimate(cell.errors.flip_ldr), makeEstimate(ratio, isFarFrom(1, ratio.low, ratio.high)), makeBias(cell.relative_bias)];
  });
}

function makeDetailTable(scene) {
  return makeCellTable(scene, ["by", "MSE", "bias²", "variance", "MAPE %", "RMSPE %", "correlation", "shared %", "flicker", "rays/px"],
    (cell, method) => [describeEffort(method, cell), makeEstimate(cell.errors.mse), makeBias(cell.bias), formatNumber(cell.bias.variance),
      makeEstimate(cell.errors.mape), makeEstimate(cell.errors.rmspe), formatNumber(cell.bias.neighbour_autocorrelation),
      cell.shared_samples ? formatNumber(100 * cell.shared_samples.mean) : "–", formatNumber(cell.flicker.mean), formatNumber(cell.counts.rays_per_pixel)]);
}

function makeEqualErrorTable(scene) {
  const targets = scene.equal_error.targets;
  const rows = scene.methods.map((method, index) => ({cells: [
    element("span", {}, swatch(index), method.label),
    ...targets.map((target) => {
      const time = target.times[index], base = target.times[0];
      if (time.is.startsWith("not")) return `> ${formatMs(time.ms)} ms`;
      const sign = time.is.startsWith("better") ? "≤ " : "";
      return `${sign}${formatMs(time.ms)} ms (${sign}${formatNumber(time.ms / base.ms)} x)`;
    })]}));
  return makeTable(["method", ...targets.map((target) => `relMSE ${formatNumber(target.rel_mse)}`)], rows);
}

function makeEqualTimeTable(scene) {
  const budgets = scene.equal_time || [];
  const rows = scene.methods.map((method, index) => ({cells: [
    element("span", {}, swatch(index), method.label),
    ...budgets.map((budget) => {
      const found = budget.ratios[index];
      if (found.reason) {
        return element("span", {class: "pm", title: `not compared: ${found.reason}`},
          `${formatNumber(found.rel_mse)}, ${found.reason}`);
      }
      if (found.label === budget.best) return `best: ${formatNumber(found.rel_mse)}`;
      return `${formatNumber(found.ratio)} x (${formatNumber(found.low)} … ${formatNumber(found.high)})`;
    })]}));
  return makeTable(["method", ...budgets.map((budget) => `${budget.budget_ms} ms`)], rows);
}

function makeSlopeTable(scene) {
  return makeTable(["method", "slope", "95 % interval"], scene.methods.map((method, index) => ({cells: [
    element("span", {}, swatch(index), method.label), formatNumber(method.slope.mean),
    `${formatNumber(method.slope.low)} … ${formatNumber(method.slope.high)}`]})));
}

function makeCountTable(scene) {
  const names = Object.keys(scene.methods[0].cells[0].counts).filter((name) => name !== "rays_per_pixel");
  const rows = scene.methods.map((method, index) => ({cells: [
    element("span", {}, swatch(index), method.label),
    ...names.map((name) => {
      const sum = method.cells.reduce((total, cell) => total + (cell.counts[name] || 0), 0);
      return element("span", sum > 0 ? {class: "mark"} : {}, String(sum));
    })]}));
  return makeTable(["method", ...names.map((name) => name.replaceAll("_", " "))], rows);
}

function makeSettingTable(scene) {
  const names = Object.keys(scene.methods[0].settings);
  return makeTable(["setting", ...scene.methods.map((method) => method.label)], names.map((name) => ({
    cells: [name, ...scene.methods.map((method) => String(method.settings[name]))]})));
}

function describeMachine(machine) {
  return `${machine.cpu}, ${machine.threads} of ${machine.cores} cores; ${machine.gl_renderer}; ` +
    `Mesa ${machine.mesa}; Embree ${machine.embree}`;
}

// Results of programs that did not say which they are have no `tarn`.
function describeProgram(results) {
  const tarn = results.tarn;
  return tarn ? `tarn ${tarn.version} (commit ${tarn.commit}, ${tarn.build_type}); ` : "";
}

function makeComparison(comparison) {
  const box = element("section", {}, element("h2", {}, `Against ${comparison.old}`), element("p", {}, comparison.summary));
  if (comparison.findings.length === 0) return box;
  box.append(makeTable(["what", "before", "now", "ratio", "verdict", "p"], comparison.findings.map((finding) => ({cells: [
    finding.what, formatNumber(finding.before), formatNumber(finding.after), formatNumber(finding.ratio),
    element("span", {class: ["better", "faster"].includes(finding.verdict) ? "better" : "mark"}, finding.verdict),
    formatNumber(finding.p_value)]}))));
  return box;
}
