// The ramp of colours for values, from blue to yellow, and its legend.

const kRampSize = 256;
const rampColour = d3.scale.linear().domain([0, 0.25, 0.5, 0.75, 1]).interpolate(d3.interpolateLab)
  .range(["#2f4b94", "#2f86b5", "#4bb397", "#b3d35f", "#fbdf4f"]).clamp(true);
const kRamp = Uint8Array.from(d3.merge(d3.range(kRampSize).map(i => {
  const c = d3.rgb(rampColour(i / (kRampSize - 1)));
  return [c.r, c.g, c.b];
})));

/// The entry of a part from 0 to 1.
const rampEntry = part => Math.max(0, Math.min(kRampSize - 1, Math.round(part * (kRampSize - 1))));

/// Room for a legend in a figure.
function addLegend(parent) {
  const box = add(parent, "div", null, "scale");
  add(box, "span", "", "quantity");
  add(box, "div", null, "ramp");
  return box;
}

/// Fills a figure's legend: what the colours tell, and the ramp with its values under it.
function rampLegend(figure, quantity) {
  const holder = figure.querySelector(".ramp");
  figure.querySelector(".quantity").textContent = `${quantity.name}${quantity.unit ? ` [${quantity.unit}]` : ""}`;
  holder.textContent = "";
  const width = 300, svg = d3.select(holder).append("svg")
    .attr({viewBox: `0 0 ${width + 40} 32`, role: "img", "aria-label": `colours: ${quantity.name}`});
  const steps = quantity.steps || 60, scale = quantity.scale.copy().range([0, width]);
  const bar = svg.append("g").attr("transform", "translate(20,0)");
  d3.range(steps).forEach(i => bar.append("rect").attr({x: i * width / steps, y: 0, width: width / steps + 0.5, height: 10})
    .style("fill", rampColour(i / (steps - 1))));
  const decades = quantity.scale.base !== undefined;
  const shown = decades ? scale.ticks().filter(t => Math.abs(Math.log10(t) - Math.round(Math.log10(t))) < 1e-9) : scale.ticks(5);
  shown.forEach(t => {
    bar.append("line").attr({x1: scale(t), x2: scale(t), y1: 10, y2: 14}).style("stroke", "var(--soft)");
    bar.append("text").attr({x: scale(t), y: 27, "text-anchor": "middle"}).text(short(t));
  });
}
