// What the player can colour particles by: a name, a scale for the legend, and an entry of the ramp for each particle.

const kRampSize = 256;
const rampColour = d3.scale.linear().domain([0, 0.25, 0.5, 0.75, 1]).interpolate(d3.interpolateLab)
  .range(["#2f4b94", "#2f86b5", "#4bb397", "#b3d35f", "#fbdf4f"]).clamp(true);
const kRamp = Uint8Array.from(d3.merge(d3.range(kRampSize).map(i => {
  const c = d3.rgb(rampColour(i / (kRampSize - 1)));
  return [c.r, c.g, c.b];
})));

/// List of {name, unit, scale (of D3, from values to 0..1), entry(frame, particle) of the ramp}. Scales end at the highest
/// value from the start of dosing on; what lies outside takes the colour of the end.
function quantities(player, frames) {
  const n = frames.particles, from = player.frames.settled * n;
  const entry = part => Math.max(0, Math.min(kRampSize - 1, Math.round(part * (kRampSize - 1))));
  const speedOf = level => player.slowest_m_s * Math.pow(player.fastest_m_s / player.slowest_m_s, (level - 1) / 254);
  const highest = list => list.subarray(from).reduce((most, level) => Math.max(most, level), 1);

  const fastest = speedOf(highest(frames.speed));
  const speed = d3.scale.log().domain([fastest / 1e3, fastest]);
  const speedEntries = d3.range(256).map(level => (level === 0 ? 0 : entry(speed(speedOf(level)))));

  // Kinetic energy of translation, as powers of ten [J]: that of 1 m/s of each particle, and that of each level.
  const heavy = Float64Array.from(frames.radius, r => Math.log10(2 / 3 * Math.PI * player.density * r ** 3));
  const quick = Float64Array.from(d3.range(256), level => (level === 0 ? -Infinity : 2 * Math.log10(speedOf(level))));
  let most = -Infinity;
  for (let j = from; j < frames.speed.length; ++j) most = Math.max(most, heavy[j % n] + quick[frames.speed[j]]);
  if (most === -Infinity) most = d3.max(heavy) + quick[1];

  const deepestLevel = highest(frames.overlap), deepest = player.most_overlap * (deepestLevel / 255) ** 2;
  const radius = d3.scale.linear().domain(d3.extent(frames.radius));
  const flat = d3.max(frames.radius) === d3.min(frames.radius);

  return [
    {name: "speed", unit: "m/s", scale: speed, entry: (f, i) => speedEntries[frames.speed[f * n + i]]},
    {name: "kinetic energy", unit: "J", scale: d3.scale.log().domain([10 ** (most - 6), 10 ** most]),
     entry: (f, i) => entry((heavy[i] + quick[frames.speed[f * n + i]] - most + 6) / 6)},
    {name: "overlap over radius", unit: "", scale: d3.scale.sqrt().domain([0, deepest]),
     entry: (f, i) => entry(frames.overlap[f * n + i] / deepestLevel)},
    {name: "radius", unit: "mm", scale: d3.scale.linear().domain(radius.domain().map(r => r * 1e3)),
     entry: (f, i) => (flat ? kRampSize / 2 : entry(radius(frames.radius[i])))},
    layers(player, frames, entry),
  ];
}

/// Eight layers of equal height, by where a particle lies when dosing starts.
function layers(player, frames, entry) {
  const n = frames.particles, settled = player.frames.settled, kLayers = 8;
  const [low, high] = [player.low[1], player.high[1]];
  const heights = Float64Array.from({length: n}, (_, i) =>
    low + (high - low) * frames.position[3 * (settled * n + i) + 1] / 65535);
  const present = Array.from(heights).filter((_, i) => frames.gone[i] > settled);
  const [bottom, top] = present.length > 0 ? d3.extent(present) : [0, 1];
  const layer = Uint8Array.from(heights, y =>
    entry(Math.max(0, Math.min(kLayers - 1, Math.floor((y - bottom) / (top - bottom || 1) * kLayers))) / (kLayers - 1)));
  const floor = player.canister ? -player.canister.width / 2 : 0;
  return {name: "layer of the fill", unit: "mm high", steps: kLayers,
          scale: d3.scale.linear().domain([(bottom - floor) * 1e3, (top - floor) * 1e3]), entry: (f, i) => layer[i]};
}

/// The ramp with its values under it.
function rampLegend(holder, quantity) {
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
