// The plots, by Chart.js.
"use strict";

const METRIC_NAMES = {mse: "MSE", rel_mse: "relMSE", rel_mse_trimmed: "relMSE, trimmed", flip_ldr: "FLIP", mape: "MAPE, %"};

function setChartDefaults() {
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;
  Chart.defaults.color = styleOf("--quiet");
  Chart.defaults.borderColor = styleOf("--line");
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  Chart.defaults.plugins.legend.labels.boxWidth = 12;
}

// A figure with a canvas; the chart follows once the figure is on the page.
function makeFigure(caption, makeConfiguration) {
  const canvas = element("canvas", {role: "img", "aria-label": caption});
  const figure = element("figure", {}, element("figcaption", {}, caption), element("div", {class: "chart"}, canvas));
  figure.draw = () => { canvas.chart = new Chart(canvas, makeConfiguration()); };
  return figure;
}

function drawFigures(box) {
  for (const figure of box.querySelectorAll("figure")) if (figure.draw) figure.draw();
}

// 1, 2 and 5 of each power of ten.
function labelLogarithmic(value) {
  const digit = value / 10 ** Math.floor(Math.log10(value) + 1e-9);
  return [1, 2, 5].some((good) => Math.abs(digit - good) < 1e-6) ? String(Number(value.toPrecision(1))) : "";
}

// As wide as the values, and a little more.
function logarithmicAxis(title, values) {
  const positive = values.filter((value) => value > 0);
  return {type: "logarithmic", min: 0.8 * Math.min(...positive), max: 1.25 * Math.max(...positive), title: {display: true, text: title}, ticks: {callback: labelLogarithmic, autoSkip: false,
    maxRotation: 0}};
}

// Lines with a band from low to high behind each; points are {x, mean, low, high, note}.
function makeBandConfiguration(lines, xTitle, yTitle) {
  const datasets = [], all = lines.flatMap((line) => line.points);
  for (const line of lines) {
    const points = line.points.filter((point) => point.mean > 0);
    const edge = (get) => points.map((point) => ({x: point.x, y: get(point)}));
    const band = {showLine: true, pointRadius: 0, borderWidth: 0, isBand: true};
    datasets.push({label: line.label, showLine: true, borderColor: line.colour, backgroundColor: line.colour,
      borderWidth: 2, pointRadius: 3, data: points.map((point) => ({...point, y: point.mean}))});
    datasets.push({...band, data: edge((point) => Math.max(point.low, point.mean / 10)), fill: false});
    datasets.push({...band, data: edge((point) => point.high), fill: "-1", backgroundColor: line.colour + "30"});
  }
  return {type: "scatter", data: {datasets}, options: {
    scales: {x: logarithmicAxis(xTitle, all.map((point) => point.x)),
      y: logarithmicAxis(yTitle, all.flatMap((point) => [Math.max(point.low, point.mean / 10), point.high]))},
    plugins: {
      legend: {labels: {filter: (item, data) => !data.datasets[item.datasetIndex].isBand}},
      tooltip: {filter: (item) => !item.dataset.isBand, callbacks: {label: (item) =>
        `${item.dataset.label}: ${formatNumber(item.raw.mean)} (${formatNumber(item.raw.low)} … ` +
        `${formatNumber(item.raw.high)}) in ${formatMs(item.raw.x)} ms ${item.raw.note || ""}`}},
    }}};
}

function makeConvergence(scene, metric) {
  return makeBandConfiguration(scene.methods.map((method, index) => ({
    label: method.label, colour: colourOf(index),
    points: method.curve.map((point) => ({x: point.ms, ...point[metric], note: `(${point.frames} frames)`})),
  })), "time, ms", METRIC_NAMES[metric]);
}

function makeErrorAgainstTime(scene, metric) {
  return makeBandConfiguration(scene.methods.map((method, index) => ({
    label: method.label, colour: colourOf(index),
    points: method.cells.filter((cell) => cell.kind === "budget").map((cell) => ({
      x: cell.ms.median, mean: cell.errors[metric].mean, low: cell.errors[metric].low, high: cell.errors[metric].high,
      note: `(budget ${cell.budget_ms} ms: ${describeEffort(method, cell)})`})),
  })), "time, ms", METRIC_NAMES[metric]);
}

// One bar a method, one colour a pass. `rows` are {label, passes: [{name, ms}]}.
function makePassBars(rows) {
  const names = [];
  for (const row of rows) for (const pass of row.passes) if (!names.includes(pass.name)) names.push(pass.name);
  const find = (row, name) => (row.passes.find((pass) => pass.name === name) || {ms: 0}).ms;
  return {type: "bar", data: {labels: rows.map((row) => row.label), datasets: names.map((name, index) => ({
    label: name, backgroundColor: PASS_PALETTE[index % PASS_PALETTE.length], data: rows.map((row) => find(row, name))}))},
  options: {indexAxis: "y", scales: {x: {stacked: true, title: {display: true, text: "ms a frame, medians"}},
    y: {stacked: true}}}};
}

function makeScenePassBars(scene) {
  return makePassBars(scene.methods.map((method) => ({label: method.label,
    passes: method.cells.find((cell) => cell.kind === "mean").passes.map((pass) => ({name: pass.name, ms: pass.ms.median}))})));
}

// Lines over frame numbers; `lines` are {label, colour, points: [{x, y}]}.
function makeFrameLines(lines, yTitle, isLogarithmic) {
  return {type: "scatter", data: {datasets: lines.map((line) => ({label: line.label, data: line.points, showLine: true,
    borderColor: line.colour, backgroundColor: line.colour, borderWidth: 1.5, pointRadius: line.points.length > 60 ? 0 : 2}))},
  options: {scales: {x: {type: "linear", title: {display: true, text: "frame"}},
    y: isLogarithmic ? logarithmicAxis(yTitle, lines.flatMap((line) => line.points.map((point) => point.y))) : {beginAtZero: true, title: {display: true, text: yTitle}}}}};
}
