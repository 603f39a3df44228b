// Data that the page keeps deflated, and places in time.

/// The bytes of a zlib stream in base64.
async function inflated(text) {
  const characters = atob(text), packed = new Uint8Array(characters.length);
  for (let i = 0; i < packed.length; ++i) packed[i] = characters.charCodeAt(i);
  const plain = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(plain).arrayBuffer());
}

/// The number of the time nearest to a time [s], in a list that ascends.
function nearestTime(times, time) {
  const i = d3.bisectLeft(times, time);
  return i > 0 && (i === times.length || time - times[i - 1] < times[i] - time) ? i - 1 : i;
}
