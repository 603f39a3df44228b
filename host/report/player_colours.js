// The quantities that colour particles: a name, a scale for the legend, and an entry of the ramp for each particle.

/// List of {name, unit, scale (of D3, from values to 0..1), entry(frame, particle) of the ramp}. Scales end at the highest
/// value from the start of dosing on; what lies outside takes the colour of the end.
function quantities(player, frames) {
  const n = frames.particles, from = player.frames.settled * n;
  const speedOf = level => player.slowest_m_s * Math.pow(player.fastest_m_s / player.slowest_m_s, (level - 1) / 254);
  const highest = list => list.subarray(from).reduce((most, level) => Math.max(most, level), 1);

  const fastest = speedOf(highest(frames.speed));
  const speed = d3.scale.log().domain([fastest / 1e3, fastest]);
  const speedEntries = d3.range(256).map(level => (level === 0 ? 0 : rampEntry(speed(speedOf(level)))));

  // Kinetic energy of translation, as powers of ten [J]: that of 1 m/s of each particle, and that of each level.
  const heavy = Float64Array.from(frames.radius, (r, i) =>
    Math.log10(2 / 3 * Math.PI * player.powders[frames.powder[i]].density * r ** 3));
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
     entry: (f, i) => rampEntry((heavy[i] + quick[frames.speed[f * n + i]] - most + 6) / 6)},
    {name: "overlap over radius", unit: "", scale: d3.scale.sqrt().domain([0, deepest]),
     entry: (f, i) => rampEntry(frames.overlap[f * n + i] / deepestLevel)},
    {name: "radius", unit: "mm", scale: d3.scale.linear().domain(radius.domain().map(r => r * 1e3)),
     entry: (f, i) => (flat ? kRampSize / 2 : rampEntry(radius(frames.radius[i])))},
    layers(player, frames),
    ...(player.powders.length > 1 ? [powders(player, frames)] : []),
    ...player.properties.map((property, k) => ownQuantity(property, frames.properties[k], n)),
  ];
}

/// A number that a user's law gives each particle, on one scale for all frames.
function ownQuantity(property, levels, n) {
  const low = d3.min(property.low), high = d3.max(property.high), span = high - low;
  const value = (f, level) => property.low[f] + (property.high[f] - property.low[f]) * level / 255;
  return {name: property.name, unit: "", scale: d3.scale.linear().domain(span > 0 ? [low, high] : [low - 0.5, low + 0.5]),
          entry: (f, i) => (span > 0 ? rampEntry((value(f, levels[f * n + i]) - low) / span) : kRampSize / 2)};
}

/// A step of the scale for each powder, numbered in the order of the case.
function powders(player, frames) {
  const n = player.powders.length;
  return {name: "powder", unit: player.powders.map((p, k) => `${k + 1}: ${p.name}`).join(", "), steps: n,
          scale: d3.scale.linear().domain([0.5, n + 0.5]), entry: (f, i) => rampEntry(frames.powder[i] / (n - 1))};
}

/// Eight layers of equal height, by where a particle lies when dosing starts.
function layers(player, frames) {
  const n = frames.particles, settled = player.frames.settled, kLayers = 8;
  const [low, high] = [player.low[1], player.high[1]];
  const heights = Float64Array.from({length: n}, (_, i) =>
    low + (high - low) * frames.position[3 * (settled * n + i) + 1] / 65535);
  const present = Array.from(heights).filter((_, i) => frames.here(i, settled));
  const [bottom, top] = present.length > 0 ? d3.extent(present) : [0, 1];
  const layer = Uint8Array.from(heights, y =>
    rampEntry(Math.max(0, Math.min(kLayers - 1, Math.floor((y - bottom) / (top - bottom || 1) * kLayers))) / (kLayers - 1)));
  const floor = player.canister ? -player.canister.width / 2 : 0;
  return {name: "layer of the fill", unit: "mm high", steps: kLayers,
          scale: d3.scale.linear().domain([(bottom - floor) * 1e3, (top - floor) * 1e3]), entry: (f, i) => layer[i]};
}
