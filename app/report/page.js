"use strict";
// Draws the JSON of chart_json.cpp in every figure of the page.

const text = "#1c2430", muted = "#5b6675", grid = "#e6e9ee";
const short = (value, digits = 6) => String(Number(value.toPrecision(digits)));

Chart.defaults.animation = false;
Chart.defaults.locale = "en-US";
Chart.defaults.color = muted;
Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
Chart.defaults.devicePixelRatio = Math.max(2, window.devicePixelRatio);

// So few points of a line are marked: what lies between them was not measured.
const fewPoints = 40;

const joined = (points) => points.x.map((x, i) => ({x: x, y: points.y[i]}));

// A sample between two gaps has no line to show it.
const lonely = (y) => y.map((v, i) => v !== null && (y[i - 1] ?? null) === null && (y[i + 1] ?? null) === null);

function line(series, place) {
  const common = {label: series.name, place: place, borderColor: series.colour};
  const edge = {...common, band: true, order: 1, borderWidth: 0, pointRadius: 0, pointHitRadius: 0};
  const band = !series.lower ? [] : [
    {...edge, data: joined(series.lower)},
    {...edge, data: joined(series.upper), fill: "-1", backgroundColor: series.colour + "2e"},
  ];
  return [...band, {
    ...common,
    data: joined(series),
    order: -place,
    backgroundColor: series.colour,
    borderWidth: 1.6,
    borderDash: series.dashed ? [6, 4] : [],
    borderJoinStyle: "round",
    pointRadius: series.x.length <= fewPoints ? 2.4 : lonely(series.y).map((alone) => alone ? 1.6 : 0),
    pointHoverRadius: 3.5,
  }];
}

function scatter(series, place) {
  return [{
    label: series.name, place: place, data: joined(series), order: -place,
    backgroundColor: series.colour + "80", borderWidth: 0, pointRadius: 2, pointHoverRadius: 4,
  }];
}

function bars(series, place) {
  return [{
    label: series.name, place: place, data: series.y, order: place,
    backgroundColor: series.colour, maxBarThickness: 48,
  }];
}

function histogram(series, place) {
  return [{
    label: series.name, place: place, data: joined(series), order: -place, grouped: false,
    backgroundColor: series.colour + "73", borderColor: series.colour, borderWidth: 1,
    barPercentage: 1, categoryPercentage: 1,
  }];
}

const makers = {line: line, scatter: scatter, bar: bars, histogram: histogram};

const power = (value) => value < 1e-3 || value > 1e4 ? value.toExponential().replace("+", "") : short(value);

// Whether a tick of a logarithmic axis has a number: powers of ten, of many decades every few; with few decades 2 and 5
// of each, too; and within less than a decade all.
function hasNumber(value, decades) {
  const exponent = Math.floor(Math.log10(value) + 1e-9), mantissa = Math.round(value / 10 ** exponent);
  if (decades < 0.3) return true;
  if (decades < 0.7) return mantissa !== 7 && mantissa !== 9;  // they would touch their neighbours
  if (decades < 2.5) return mantissa === 1 || mantissa === 2 || mantissa === 5;
  return mantissa === 1 && exponent % Math.ceil(decades / 8) === 0;
}

function logTick(value, index, ticks) {
  return hasNumber(value, Math.log10(ticks[ticks.length - 1].value / ticks[0].value)) ? power(value) : "";
}

// Chart.js gives an axis that ends at its data the tick before them, too.
function dropTicksOutside(axis) {
  axis.ticks = axis.ticks.filter(
      (tick) => tick.value >= axis.min * (1 - 1e-9) && tick.value <= axis.max * (1 + 1e-9));
}

function axis(label, log) {
  const common = {title: {display: label !== "", text: label, color: text}, grid: {color: grid, borderColor: muted}};
  if (!log) return {...common, type: "linear", ticks: {maxRotation: 0, callback: (value) => short(value, 10)}};
  return {...common, type: "logarithmic", afterBuildTicks: dropTicksOutside,
          ticks: {callback: logTick, maxRotation: 0, autoSkip: false}};
}

// Of more numbers than a call may have arguments.
const extremes = (values) => values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)],
                                           [Infinity, -Infinity]);

// Room around a line that does not move, in its own order of magnitude; nothing for others.
function rangeOfConstant(series) {
  const values = series.flatMap((one) => one.lower ? [one.y, one.lower.y, one.upper.y] : [one.y]).flat()
      .filter((value) => value !== null);
  const [low, high] = extremes(values), size = Math.max(Math.abs(low), Math.abs(high));
  if (values.length === 0 || high - low > 1e-6 * size) return {};
  return size === 0 ? {min: 0, max: 1} : {min: Math.min(0, 2 * low), max: Math.max(0, 2 * high)};
}

function axes(chart) {
  const x = axis(chart.x_label, chart.log_x);
  const y = axis(chart.y_label, chart.log_y);
  if (chart.kind === "line") {
    // The axis ends with the data, and its ticks are at round numbers all the same.
    const [first, last] = extremes(chart.series.flatMap((series) => series.x));
    if (first < last) Object.assign(x, {min: first, max: last});
    x.ticks.includeBounds = false;
    if (!chart.log_y) Object.assign(y, rangeOfConstant(chart.series));
  }
  if (chart.kind === "bar") {
    x.type = "category";
    x.grid = {display: false, borderColor: muted};
  }
  if (chart.kind === "bar" || chart.kind === "histogram") y.grace = "5%";
  const centres = chart.series.map((series) => series.x).find((centres) => centres.length > 1);
  if (chart.kind === "histogram" && centres) {
    const half = (centres[1] - centres[0]) / 2;
    x.min = centres[0] - half;
    x.max = centres[centres.length - 1] + half;
    x.ticks.includeBounds = false;
    x.grid = {...x.grid, offset: false};
  }
  return {x: x, y: y};
}

const shading = (regions) => ({
  id: "regions",
  beforeDatasetsDraw(chart) {
    const {ctx, chartArea: area, scales: {x}} = chart;
    const inside = (pixel) => Math.min(Math.max(pixel, area.left), area.right);
    for (const region of regions) {
      const left = region.from === null ? area.left : inside(x.getPixelForValue(region.from));
      const right = region.to === null ? area.right : inside(x.getPixelForValue(region.to));
      if (right <= left) continue;
      ctx.save();
      ctx.fillStyle = "rgba(91, 102, 117, 0.13)";
      ctx.fillRect(left, area.top, right - left, area.bottom - area.top);
      ctx.fillStyle = muted;
      ctx.font = "12px " + Chart.defaults.font.family;
      ctx.textBaseline = "top";
      // Beside a region that is too narrow for it.
      const width = ctx.measureText(region.label).width;
      const fits = width <= right - left - 8 || right + width + 4 > area.right;
      ctx.fillText(region.label, fits ? left + 6 : right + 4, area.top + 5);
      ctx.restore();
    }
  },
});

// A series and its band go together.
function toggle(event, item, legend) {
  const chart = legend.chart;
  const visible = !chart.isDatasetVisible(item.datasetIndex);
  const place = chart.data.datasets[item.datasetIndex].place;
  chart.data.datasets.forEach((set, i) => {
    if (set.place === place) chart.setDatasetVisibility(i, visible);
  });
  chart.update();
}

// Chart.js shows the style of the points; a line's legend shows the line.
function lineLabels(chart) {
  return Chart.defaults.plugins.legend.labels.generateLabels(chart).map((item) => (
    {...item, lineDash: chart.data.datasets[item.datasetIndex].borderDash, lineWidth: 2}));
}

function plugins(chart) {
  const numeric = chart.kind !== "bar";
  return {
    legend: {
      display: chart.series.some((series) => series.name !== ""),
      align: "start",
      onClick: toggle,
      labels: {
        color: text,
        usePointStyle: true,
        pointStyleWidth: chart.kind === "line" ? 28 : 10,
        boxHeight: 7,
        ...(chart.kind === "line" ? {generateLabels: lineLabels} : {}),
        pointStyle: chart.kind === "line" ? "line" : chart.kind === "scatter" ? "circle" : "rect",
        filter: (item, data) => item.text !== "" && !data.datasets[item.datasetIndex].band,
        sort: (a, b) => a.datasetIndex - b.datasetIndex,
      },
    },
    tooltip: {
      filter: (item) => !item.dataset.band,
      callbacks: {
        title: (items) => !items.length ? "" : numeric ? chart.x_label + ": " + short(items[0].parsed.x, 10) : items[0].label,
        label: (item) => (item.dataset.label ? item.dataset.label + ": " : "") + short(item.parsed.y),
      },
    },
  };
}

function draw(figure) {
  const chart = JSON.parse(figure.querySelector("script").textContent);
  return new Chart(figure.querySelector("canvas"), {
    type: chart.kind === "histogram" ? "bar" : chart.kind,
    data: {labels: chart.kind === "bar" ? chart.categories : undefined,
           datasets: chart.series.flatMap(makers[chart.kind])},
    options: {
      maintainAspectRatio: false,
      interaction: {mode: "nearest", intersect: false},
      scales: axes(chart),
      plugins: plugins(chart),
    },
    plugins: [shading(chart.regions)],
  });
}

const charts = Array.from(document.querySelectorAll("figure.chart"), draw);
addEventListener("beforeprint", () => charts.forEach((chart) => chart.resize()));
