// The frames of a run out of the page; how they are packed stands in host/report/player_data.h.

/// Resolves to {count, particles, radius [m], powder (its number), here (whether a particle is in a frame), position (three of 65535 parts of
/// the box for each particle and frame), speed, overlap (levels), properties (a list of levels), surface (of 65535 parts of the box's height)}.
async function readFrames(player) {
  const bytes = await inflated(player.stream);
  player.stream = null;
  return unpackFrames(player, bytes);
}

function unpackFrames(player, bytes) {
  const n = player.particles, k = player.columns, count = player.frames.time_s.length;
  let at = 0;
  const words = size => {
    const list = new Uint16Array(size);
    for (let i = 0; i < size; ++i) list[i] = bytes[at + i] | bytes[at + size + i] << 8;
    at += 2 * size;
    return list;
  };
  const frames = {
    count, particles: n, position: new Uint16Array(3 * n * count), speed: new Uint8Array(n * count),
    overlap: new Uint8Array(n * count), surface: new Uint16Array(k * count),
    properties: player.properties.map(() => new Uint8Array(n * count)),
  };
  // Adds the differences to the values of the frame before. The width of the arrays makes the sums modulo 2^16 or 2^8.
  const add = (into, first, step, before, changes) => {
    for (let i = 0, j = first; i < changes.length; ++i, j += step) into[j] = (before < 0 ? 0 : into[j - first + before]) + changes[i];
  };
  const signed = list => Int32Array.from(list, c => c >>> 1 ^ -(c & 1));
  const levels = () => bytes.subarray(at, at += n);

  const [low, high] = player.radius_m;
  frames.radius = Float64Array.from(words(n), w => low + (high - low) * w / 65535);
  frames.powder = player.powders.length > 1 ? levels() : new Uint8Array(n);
  for (let f = 0; f < count; ++f) {
    const before = size => (f > 0 ? (f - 1) * size : -1);
    for (let axis = 0; axis < 3; ++axis)
      add(frames.position, 3 * n * f + axis, 3, f > 0 ? before(3 * n) + axis : -1, signed(words(n)));
    add(frames.speed, n * f, 1, before(n), levels());
    add(frames.overlap, n * f, 1, before(n), levels());
    for (const property of frames.properties) add(property, n * f, 1, before(n), levels());
    if (k > 0) add(frames.surface, k * f, 1, before(k), signed(words(k)));
  }
  const came = words(n), gone = words(n);  // first frame with the particle, first without it again
  frames.here = (i, f) => came[i] <= f && f < gone[i];
  if (at !== bytes.length) throw new Error(`${bytes.length} bytes of frames, ${at} expected`);
  return frames;
}
