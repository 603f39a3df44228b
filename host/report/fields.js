// The fields of a run: maps of a plane, which follow the player's clock or their own slider, and height profiles.

/// Resolves to the levels of each quantity: for every map, row after row from above, a byte for a cell.
async function readMaps(map) {
  const bytes = await inflated(map.stream), cells = map.cells[0] * map.cells[1], count = map.time_s.length;
  map.stream = null;
  const levels = map.quantities.map(() => new Uint8Array(cells * count));
  let at = 0;
  for (let f = 0; f < count; ++f)
    levels.forEach(list => {
      const here = f * cells, before = here - cells;
      for (let i = 0; i < cells; ++i) list[here + i] = (f > 0 ? list[before + i] : 0) + bytes[at++];
    });
  if (at !== bytes.length) throw new Error(`${bytes.length} bytes of maps, ${at} expected`);
  return levels;
}

/// Of a level of a signed scale, in parts of the largest value.
const signedPart = level => Math.sign(level - 128) * ((level - 128) / 127) ** 2;

/// List of {name, unit, scale (of D3, from values to 0..1), entry(cell of all maps) of the ramp}. `velocity` gives the
/// two in-plane parts of a cell's velocity [largest speed].
function fieldQuantities(map, levels) {
  const [density, across, up] = levels, velocity = i => [signedPart(across[i]), signedPart(up[i])];
  const speed = d3.scale.log().domain([1e-3, 1]), fastest = map.quantities[1].most;
  const plain = q => {
    const {name, unit, scale, most} = map.quantities[q];
    return {name, unit, entry: i => levels[q][i],
            scale: (scale === "root" ? d3.scale.sqrt() : d3.scale.linear()).domain([0, most > 0 ? most : 1])};
  };
  const ofSpeed = {name: "speed in the plane", unit: "m/s", scale: speed.copy().domain(fastest > 0 ? [fastest / 1e3, fastest] : [1e-3, 1]),
                   entry: i => rampEntry(speed(Math.max(1e-3, Math.hypot(...velocity(i)))))};
  const rest = d3.range(3, levels.length).map(plain);
  return {list: [plain(0), ofSpeed].concat(rest), velocity, dense: i => density[i] >= map.sparse_level};
}

/// The arrow of a velocity at a place on the page: its length is the root of the speed.
function arrow(x, y, [across, up], longest) {
  const speed = Math.hypot(across, up), length = longest * Math.sqrt(speed), [dx, dy] = [across / speed * length, -up / speed * length];
  const [endX, endY] = [x + dx / 2, y + dy / 2], head = 0.3;
  const barb = side => `M${endX},${endY}l${head * (-dx + side * dy)},${head * (-dy - side * dx)}`;
  return `M${x - dx / 2},${y - dy / 2}L${endX},${endY}${barb(0.7)}${barb(-0.7)}`;
}

const kMapMargin = {top: 24, right: 12, bottom: 40, left: 52};
const kTallestMap = 420, kArrowSpacing = 15;  // [CSS pixels]

/// The uppermost row that has powder in some map from the settled bed on. Higher rows are left out, because they would
/// leave little room for the rest.
function firstRow(map, quantities, settled) {
  const [columns, rows] = map.cells;
  let first = rows;
  for (let i = settled * columns * rows; i < map.time_s.length * columns * rows; ++i)
    if (quantities.dense(i)) first = Math.min(first, Math.floor(i / columns) % rows);
  return first === rows ? 0 : Math.max(0, first - 1);
}

/// Draws axes, colours and arrows; returns show(map, quantity). `top`: rows left out above.
function plane(holder, map, quantities, top) {
  const [columns, all] = map.cells, rows = all - top, title = `field ${map.name}`;
  const high = map.high_m[1] - top * (map.high_m[1] - map.low_m[1]) / all;
  const inMillimetres = k => [map.low_m[k] * milli, [map.high_m[0], high][k] * milli];
  const tallness = (high - map.low_m[1]) / (map.high_m[0] - map.low_m[0]);
  let shown = null, draw = () => {};
  drawn(holder, outer => {
    const wide = outer - kMapMargin.left - kMapMargin.right, width = Math.min(wide, kTallestMap / tallness), height = width * tallness;
    const outerHeight = height + kMapMargin.top + kMapMargin.bottom, c = canvas(holder, outer, outerHeight, kMapMargin, title);
    c.width = width;
    const x = d3.scale.linear().domain(inMillimetres(0)).range([0, width]), y = d3.scale.linear().domain(inMillimetres(1)).range([height, 0]);
    axes(c, {x: {label: `${map.axes[0]} [mm]`}, y: {label: `${map.axes[1]} [mm]`}}, x, y);
    const picture = add(holder, "canvas"), arrows = c.plot.append("path").attr("class", "arrows");
    Object.assign(picture, {width: columns, height: rows});
    const share = (part, whole) => `${100 * part / whole}%`;
    Object.assign(picture.style, {left: share(kMapMargin.left, outer), top: share(kMapMargin.top, outerHeight),
                                  width: share(width, outer), height: share(height, outerHeight)});
    const context = picture.getContext("2d"), pixels = context.createImageData(columns, rows);
    const cell = width / columns, step = Math.max(1, Math.round(kArrowSpacing / cell)), first = Math.floor(step / 2);
    draw = (f, quantity) => {
      const from = (f * all + top) * columns;
      let paths = "";
      for (let row = 0, i = 0; row < rows; ++row)
        for (let column = 0; column < columns; ++column, ++i) {
          const here = quantities.dense(from + i), at = 3 * quantity.entry(from + i);
          for (let k = 0; k < 3; ++k) pixels.data[4 * i + k] = kRamp[at + k];
          pixels.data[4 * i + 3] = here ? 255 : 0;
          if (!here || row % step !== first || column % step !== first) continue;
          const velocity = quantities.velocity(from + i);
          if (Math.hypot(...velocity) >= 1e-3)
            paths += arrow((column + 0.5) * cell, (row + 0.5) * height / rows, velocity, kArrowSpacing * 1.8);
        }
      context.putImageData(pixels, 0, 0);
      arrows.attr("d", paths);
    };
    if (shown) draw(...shown);
  });
  return (f, quantity) => {
    shown = [f, quantity];
    draw(f, quantity);
  };
}

const kPhaseNames = ["settle", "rotate", "rest", "reverse"];

function mapControls(box, run, map, levels) {
  const times = map.time_s, quantities = fieldQuantities(map, levels), state = box.querySelector(".state");
  const settled = Math.max(0, map.dose.lastIndexOf(0)), draw = plane(box.querySelector(".plane"), map, quantities, firstRow(map, quantities, settled));
  let shown = 0, quantity = quantities.list[0], leading = false;
  const row = add(box, "div", null, "row");
  const time = slider(row, "time of the field", times.length - 1, i => {
    show(i);
    leading = true;  // the frame nearest to this map may be nearer to another
    if (run.player) clock.jump(times[i]);
    leading = false;
  });
  choice(row, "colour", quantities.list.map(q => q.name), i => {
    quantity = quantities.list[i];
    paint();
  });
  const show = i => {
    shown = i;
    time.value = i;
    const where = momentText(times[i], map.dose[i], kPhaseNames.indexOf(map.phase[i]));
    time.setAttribute("aria-valuetext", where);
    state.textContent = `${where}; map ${i + 1} of ${times.length}`;
    draw(i, quantity);
  };
  const paint = () => {
    rampLegend(box, quantity);
    draw(shown, quantity);
  };
  const follow = () => {
    if (!leading && clock.time !== null) show(nearestTime(times, clock.time));
  };
  paint();
  show(settled);
  if (!run.player) return;
  clock.follow(follow);
  follow();
}

function mapNote(map) {
  const at = [map.over.low_m, map.over.high_m].map(x => short(x * milli)), fewer = map.time_s.length < map.stored;
  return `Coarse-grained: ${map.kernel} kernel of ${short(map.width_m * milli)} mm, mean over ${map.over.axis} from ${at[0]} to ${at[1]} mm`
    + (map.average ? " and over the time since the map before" : "")
    + ". Arrows: velocity in the plane, as long as the root of its size. Blank: next to no powder."
    + (fewer ? ` ${map.time_s.length} of the ${map.stored} maps stored are in this file.` : "");
}

function mapFigure(parent, run, map) {
  const box = add(parent, "figure", null, "viewer field");
  box.dataset.state = "loading";
  add(box, "h3", `Field: ${map.name}`);
  const state = add(box, "p", "unpacking the maps", "state"), stage = add(box, "div", null, "plane"), legend = addLegend(box);
  const load = async () => {
    if (map.stream === null) throw new Error("its maps are too fine for a page; tools/field-map draws them");
    mapControls(box, run, map, await readMaps(map));
    add(box, "figcaption", mapNote(map));
    box.dataset.state = "ready";
  };
  load().catch(error => {
    state.textContent = `The field cannot be shown here: ${error.message || error}.`;
    stage.remove();
    legend.remove();
    box.dataset.state = "failed";
  });
}

function profileChart(parent, run, profile) {
  const states = everyFewDoses(profile.states, new Set()), now = {name: "in the player", points: [], colour: "var(--ink)"};
  const points = state => zip(profile.z_m.map(z => z * milli), state.height_m, milli);
  const series = states.map((state, i) => ({name: doseName(state.dose), points: points(state), colour: colour(i, states.length), thin: true}));
  if (run.player) now.points = points(profile.states[0]);
  const again = chart(parent, {
    title: `Height profile: ${profile.name}`, x: {label: "z [mm]", from: 0, to: profile.length_m * milli}, y: {label: "mm"},
    series: series.concat(run.player ? [now] : []),
    note: "h(z, t) = ρ(z, t)/ρ(z, 0) h₀: what the mass over each place makes of the height that the settled bed had, at the end of each dose.",
  });
  if (!run.player) return;
  const times = profile.rows.map(row => row.time_s);
  clock.follow(() => {
    if (clock.time === null) return;
    now.points = points(profile.rows[nearestTime(times, clock.time)]);
    again();
  });
}

function fieldFigures(parent, run) {
  if (!run.fields) return;
  run.fields.maps.forEach(map => mapFigure(parent, run, map));
  run.fields.profiles.forEach(profile => profileChart(parent, run, profile));
}
