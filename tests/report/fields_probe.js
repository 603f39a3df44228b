// For the pages of fields_browser_test.cpp.

async function probe() {
  const box = document.querySelector(".field"), player = document.querySelector(".player"), found = {};
  while ([box, player].some(figure => figure && figure.dataset.state === "loading")) await sleep();
  found.state = box.dataset.state;
  found.player = player && player.dataset.state;
  if (found.state !== "ready") return found;
  const [time] = box.querySelectorAll("input[type=range]"), [colour] = box.querySelectorAll("select");
  const picture = () => box.querySelector("canvas");
  const now = () => {
    const {data} = picture().getContext("2d").getImageData(0, 0, picture().width, picture().height), pixels = [];
    for (let i = 0; i < data.length; i += 4) pixels.push(data[i + 3] === 0 ? "none" : data.slice(i, i + 3).join(","));
    return {pixels, text: box.querySelector(".state").textContent, player: player && player.querySelector(".state").textContent,
            quantity: box.querySelector(".quantity").textContent};
  };
  found.first = now();
  found.quantity = box.querySelector(".quantity").textContent;
  if (player) {
    setControl(player.querySelector("input[type=range]"), "value", 1, "input");
    found.led = now();
    setControl(time, "value", 2, "input");
    found.leads = now();
    return found;
  }
  setControl(time, "value", 2, "input");
  found.moved = now();
  setControl(colour, "selectedIndex", 1, "change");
  found.speed = now();
  // From tail to tip, to the right and down.
  found.arrows = Array.from(box.querySelector(".arrows").getAttribute("d").matchAll(/M([-\d.e]+),([-\d.e]+)L([-\d.e]+),([-\d.e]+)/g))
    .map(([, x, y, endX, endY]) => [endX - x, endY - y]);
  const shape = picture().getBoundingClientRect();
  found.shape = shape.width / shape.height;
  return found;
}
