"use strict";
// Charts in SVG on D3's scales, axes and shapes: lines and dots with error bars, stacked areas, a map of two axes.
// Colours are the page's, so that they follow its light and dark.

const colour = (i, count) =>
  count <= 8 ? `var(--s${i % 8})` : d3.interpolateLab("#8fc1ea", "#8355ad")(i / (count - 1));

/// A new element in `parent`; its text is text, never markup.
function add(parent, name, text, className) {
  const element = document.createElement(name);
  if (text !== undefined && text !== null) element.textContent = text;
  if (className) element.className = className;
  parent.appendChild(element);
  return element;
}

const isNumber = x => typeof x === "number" && isFinite(x);

/// Four significant digits, without a tail of zeros.
/// A mass [kg] in grams. Below a tenth of a gram three significant digits, because doses can be milligrams.
const gramsText = x =>
  (!isNumber(x) ? "" : x === 0 || Math.abs(x * gram) >= 0.1 ? (x * gram).toFixed(3) : String(Number((x * gram).toPrecision(3))));
const short = x => (isNumber(x) ? String(Number(x.toPrecision(4))) : "");

function frame(parent, title, note) {
  const figure = add(parent, "figure");
  add(figure, "h3", title);
  const legend = add(figure, "ul", null, "legend");
  const holder = add(figure, "div");
  if (note) add(figure, "figcaption", note);
  return {legend, holder};
}

const dotStyle = s => (s.hollow ? {fill: "var(--panel)", stroke: s.colour, "stroke-width": 2} : {fill: s.colour});

function legendEntry(legend, series) {
  const item = document.createElement("li");
  const svg = d3.select(item).append("svg").attr("viewBox", "0 0 22 10");
  if (series.area)
    svg.append("rect").attr({x: 1, y: 0, width: 20, height: 10}).style("fill", series.colour).style("fill-opacity", .75);
  else {
    if (series.line !== false)
      svg.append("line").attr({x1: 0, x2: 22, y1: 5, y2: 5, "stroke-dasharray": series.dash || null})
        .style("stroke", series.colour).style("stroke-width", 2);
    if (series.dots) svg.append("circle").attr({cx: 11, cy: 5, r: 3.5}).style(dotStyle(series));
  }
  item.appendChild(document.createTextNode(series.name));
  legend.appendChild(item);
}

/// The chart is drawn again whenever the width changes, so that letters keep their size. On paper it has this width
/// [CSS pixels].
const kPaperWidth = 310;
const drawings = [];
let clips = 0;
function drawn(holder, draw) {
  const again = width => {
    holder.textContent = "";
    draw(width || Math.max(280, holder.clientWidth || 560));
  };
  drawings.push(again);
  again();
  return again;
}

/// Room for the plot in a fresh SVG: {svg, plot, width, height} inside the margins.
function canvas(holder, outerWidth, outerHeight, margin, label) {
  const svg = d3.select(holder).append("svg")
    .attr({viewBox: `0 0 ${outerWidth} ${outerHeight}`, role: "img", "aria-label": label});
  const plot = svg.append("g").attr("transform", `translate(${margin.left},${margin.top})`);
  return {plot, width: outerWidth - margin.left - margin.right, height: outerHeight - margin.top - margin.bottom};
}

/// The text of a tick; what is zero but for rounding is zero.
// Small numbers would not fit beside an axis with all their zeros.
const tickText = scale => t => Math.abs(t) < 1e-9 * Math.abs(scale.domain()[1] - scale.domain()[0]) ? "0"
  : Math.abs(t) < 1e-3 ? Number(t.toPrecision(4)).toExponential() : short(t);

function axes(c, spec, x, y) {
  const grid = c.plot.append("g");
  y.ticks(5).forEach(t => grid.append("line").attr({class: "grid", x1: 0, x2: c.width, y1: y(t), y2: y(t)}));
  const below = d3.svg.axis().scale(x).orient("bottom").outerTickSize(0);
  if (spec.x.categories) below.tickValues(spec.x.categories.map((_, i) => i)).tickFormat(i => spec.x.categories[i]);
  else if (spec.x.whole)
    below.tickValues(x.ticks(Math.min(10, c.width / 40)).filter(t => t === Math.round(t))).tickFormat(d3.format("d"));
  else below.ticks(Math.max(3, Math.min(8, c.width / 70))).tickFormat(tickText(x));
  c.plot.append("g").attr({class: "axis", transform: `translate(0,${c.height})`}).call(below);
  c.plot.append("g").attr("class", "axis").call(d3.svg.axis().scale(y).orient("left").ticks(5).outerTickSize(0).tickFormat(tickText(y)));
  c.plot.append("text").attr({x: c.width, y: c.height + 34, "text-anchor": "end"}).text(spec.x.label);
  c.plot.append("text").attr({x: -44, y: -10}).text(spec.y.label);
}

function bands(c, spec, x) {
  (spec.bands || []).forEach((band, i, all) => {
    const from = x(band[0]), to = x(band[1]);
    c.plot.append("rect").attr({class: "band", x: from, y: 0, width: Math.max(0, to - from), height: c.height});
    if (all.length * 16 < c.width)
      c.plot.append("text").attr({x: (from + to) / 2, y: 12, "text-anchor": "middle"}).style("opacity", .8).text(i + 1);
  });
}

/// The parts of a curve between missing points.
function pieces(points) {
  const list = [[]];
  points.forEach(p => (isNumber(p[0]) && isNumber(p[1]) ? list[list.length - 1].push(p) : list.push([])));
  return list.filter(piece => piece.length > 0);
}

function drawSeries(parent, series, x, y) {
  const group = parent.append("g");
  const known = pieces(series.points);
  if (series.area) {
    const area = d3.svg.area().x(p => x(p[0])).y0(p => y(p[2])).y1(p => y(p[1]));
    known.forEach(piece => group.append("path").attr("d", area(piece)).style("fill", series.colour).style("fill-opacity", .75));
    return;
  }
  const line = d3.svg.line().x(p => x(p[0])).y(p => y(p[1]));
  if (series.line !== false)
    known.forEach(piece => group.append("path").attr({d: line(piece), "stroke-dasharray": series.dash || null})
      .style({fill: "none", stroke: series.colour, "stroke-width": series.thin ? 1.2 : 2, "stroke-linejoin": "round"}));
  d3.merge(known).forEach(p => {
    if (isNumber(p[2]) && p[2] > 0) errorBar(group, x(p[0]), y(p[1] - p[2]), y(p[1] + p[2]), series.colour);
    if (!series.dots) return;
    const dot = group.append("circle").attr({cx: x(p[0]), cy: y(p[1]), r: 3.5});
    dot.style(dotStyle(series));
    dot.append("title").text(`${series.name}: ${short(p[1])}${isNumber(p[2]) ? " ± " + short(p[2]) : ""} at ${short(p[0])}`);
  });
}

function errorBar(group, x, low, high, stroke) {
  [[x, x, low, high], [x - 4, x + 4, low, low], [x - 4, x + 4, high, high]].forEach(([x1, x2, y1, y2]) =>
    group.append("line").attr({x1, x2, y1, y2}).style({stroke, "stroke-width": 1.4}));
}

/// Draws a vertical rule at `link.place()`; clicking or dragging jumps there. Returns a function that moves the rule.
function follow(c, link, x) {
  const rule = c.plot.append("line").attr({class: "now", y1: 0, y2: c.height});
  const move = () => {
    const place = link.place(), [low, high] = x.domain();
    rule.style("display", isNumber(place) && place >= low && place <= high ? null : "none");
    if (isNumber(place)) rule.attr({x1: x(place), x2: x(place)});
  };
  const jump = () => link.jump(Math.max(x.domain()[0], Math.min(x.domain()[1], x.invert(d3.mouse(c.plot.node())[0]))));
  const svg = d3.select(c.plot.node().ownerSVGElement).classed("linked", true);
  svg.on("pointerdown", jump).on("pointermove", () => { if (d3.event.buttons & 1) jump(); });
  move();
  return move;
}

/// Returns what draws the chart again. link {place(): where on x, jump(x), listen(f)}: what the chart follows.
/// spec: title, note, link, x {label, whole, categories, pad, from, to}, y {label, zero, from, to, scaledFrom: x}, bands [[from, to]], level {value, name},
/// series [{name, unnamed, points [[x, y, error or lower edge]], colour, line, dots, hollow, dash, thin, area}]
function chart(parent, spec) {
  const series = spec.series.filter(s => pieces(s.points).length > 0);
  if (series.length === 0) return () => {};
  const level = spec.level && isNumber(spec.level.value) ? spec.level : null;
  const {legend, holder} = frame(parent, spec.title, spec.note);
  series.filter(s => !s.unnamed).forEach(s => legendEntry(legend, s));
  if (level) legendEntry(legend, {name: level.name, colour: "var(--ink)", dash: "2 3"});

  const points = d3.merge(series.map(s => d3.merge(pieces(s.points))));
  const error = p => (isNumber(p[2]) && !series[0].area ? p[2] : 0);
  const extent = d3.extent(points, p => p[0]);
  const scaled = points.filter(p => !isNumber(spec.y.scaledFrom) || p[0] >= spec.y.scaledFrom);
  const tall = scaled.length > 0 ? scaled : points;
  let [low, high] = [d3.min(tall, p => p[1] - error(p)), d3.max(tall, p => p[1] + error(p))];
  if (level) [low, high] = [Math.min(low, level.value), Math.max(high, level.value)];
  if (spec.y.zero !== false) [low, high] = [Math.min(0, low), Math.max(0, high)];
  if (low === high) [low, high] = [low === 0 ? 0 : low - 1, high + 1];
  if (isNumber(spec.y.from)) low = spec.y.from;
  if (isNumber(spec.y.to)) high = spec.y.to;
  if (isNumber(spec.x.from)) extent[0] = spec.x.from;
  if (isNumber(spec.x.to)) extent[1] = spec.x.to;
  if (spec.x.categories) [extent[0], extent[1]] = [-0.5, spec.x.categories.length - 0.5];
  const pad = spec.x.pad ? (extent[1] - extent[0] || 1) * 0.04 : extent[1] > extent[0] ? 0 : 1;

  let moveRule = () => {};
  if (spec.link) spec.link.listen(() => moveRule());
  return drawn(holder, width => {
    const c = canvas(holder, width, Math.min(340, Math.max(230, width * 0.52)), {top: 24, right: 12, bottom: 40, left: 52}, spec.title);
    const x = d3.scale.linear().domain([extent[0] - pad, extent[1] + pad]).range([0, c.width]);
    const y = d3.scale.linear().domain([low, high]).nice().range([c.height, 0]);
    bands(c, spec, x);
    axes(c, spec, x, y);
    const clip = `clip${++clips}`;
    c.plot.append("clipPath").attr("id", clip).append("rect").attr({x: -6, y: -6, width: c.width + 12, height: c.height + 12});
    const inside = c.plot.append("g").attr("clip-path", `url(#${clip})`);
    series.forEach(s => drawSeries(inside, s, x, y));
    if (low < 0) c.plot.append("line").attr({x1: 0, x2: c.width, y1: y(0), y2: y(0)}).style({stroke: "var(--soft)", "stroke-width": .7});
    if (level)
      c.plot.append("line").attr({x1: 0, x2: c.width, y1: y(level.value), y2: y(level.value), "stroke-dasharray": "2 3"})
        .style({stroke: "var(--ink)", "stroke-width": 1.5});
    if (spec.link) moveRule = follow(c, spec.link, x);
  });
}

/// The pieces of the line value = target within a square of four cells, as pairs of points (places in units of cells).
function crossings(i, j, at, target) {
  const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
  const values = corners.map(([a, b]) => at(a, b));
  if (!values.every(isNumber)) return [];
  const cuts = [];
  for (let k = 0; k < 4; ++k) {
    const [p, q] = [values[k], values[(k + 1) % 4]];
    if ((p < target) === (q < target)) continue;
    const t = (target - p) / (q - p), [a, b] = [corners[k], corners[(k + 1) % 4]];
    cuts.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
  }
  return cuts.length === 4 ? [[cuts[0], cuts[1]], [cuts[2], cuts[3]]] : cuts.length === 2 ? [cuts] : [];
}

/// spec: title, note, x {label, values}, y {label, values}, unit, at(i, j), target
function map(parent, spec) {
  const {legend, holder} = frame(parent, spec.title, spec.note);
  const all = [];
  spec.x.values.forEach((_, i) => spec.y.values.forEach((_, j) => isNumber(spec.at(i, j)) && all.push(spec.at(i, j))));
  if (all.length === 0) return;
  if (isNumber(spec.target)) legendEntry(legend, {name: `target ${short(spec.target)} ${spec.unit}`, colour: "#c9541f"});
  const [low, high] = d3.extent(all);
  const ramp = d3.interpolateLab("#e9f1f8", "#17528c");
  drawn(holder, width => {
    const nx = spec.x.values.length, ny = spec.y.values.length;
    const c = canvas(holder, width, Math.min(420, 70 + 46 * ny), {top: 24, right: 12, bottom: 42, left: 64}, spec.title);
    const [w, h] = [c.width / nx, c.height / ny];
    const [px, py] = [i => (i + 0.5) * w, j => c.height - (j + 0.5) * h];
    for (let i = 0; i < nx; ++i)
      for (let j = 0; j < ny; ++j) {
        const value = spec.at(i, j), share = high > low ? (value - low) / (high - low) : 0.5;
        const cell = c.plot.append("g").attr("class", "cell");
        cell.append("rect").attr({x: i * w + 1, y: py(j) - h / 2 + 1, width: w - 2, height: h - 2})
          .style({fill: isNumber(value) ? ramp(share) : "none", stroke: "var(--line)"});
        cell.append("text").attr({x: px(i), y: py(j) + 4, "text-anchor": "middle"})
          .style("fill", !isNumber(value) ? "var(--soft)" : share > 0.5 ? "#fff" : "#14222e")
          .text(isNumber(value) ? short(Number(value.toPrecision(3))) : "–");
      }
    spec.x.values.forEach((v, i) => c.plot.append("text").attr({x: px(i), y: c.height + 16, "text-anchor": "middle"}).text(v));
    spec.y.values.forEach((v, j) => c.plot.append("text").attr({x: -8, y: py(j) + 4, "text-anchor": "end"}).text(v));
    c.plot.append("text").attr({x: c.width, y: c.height + 36, "text-anchor": "end"}).text(spec.x.label);
    c.plot.append("text").attr({x: -56, y: -10}).text(spec.y.label);
    for (let i = 0; i + 1 < nx; ++i)
      for (let j = 0; j + 1 < ny; ++j)
        if (isNumber(spec.target))
          crossings(i, j, spec.at, spec.target).forEach(([p, q]) =>
            c.plot.append("line").attr({x1: px(p[0]), y1: py(p[1]), x2: px(q[0]), y2: py(q[1]), class: "contour"})
              .style({stroke: "#c9541f", "stroke-width": 2.5, "stroke-linecap": "round"}));
  });
}

/// A table; `head` [[name, is it numbers]], rows of texts or nodes.
function table(parent, head, rows) {
  const element = add(add(parent, "div", null, "wide"), "table");
  const top = add(add(element, "thead"), "tr");
  head.forEach(([name, numeric]) => add(top, "th", name, numeric ? "number" : ""));
  const body = add(element, "tbody");
  rows.forEach(row => {
    const line = add(body, "tr");
    row.forEach((cell, i) => {
      const box = add(line, "td", cell instanceof Node ? undefined : cell, head[i][1] ? "number" : "");
      if (cell instanceof Node) box.appendChild(cell);
    });
  });
}
