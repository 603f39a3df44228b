// Draws the page from its data; a fault is told on the page, where a test or a reader finds it.

try {
  const report = JSON.parse(document.getElementById("data").textContent);
  const main = document.querySelector("main");
  add(main, "h1", report.name);
  if (report.reason) add(main, "p", report.reason, "reason");
  ({run: runPage, runs: runsPage, study: studyPage, validation: validationPage})[report.kind](main, report);
  // The first charts were drawn before their neighbours took part of the width, so all are drawn again.
  const draw = width => drawings.forEach(again => again(width));
  draw();
  let waiting = 0;
  window.addEventListener("resize", () => {
    cancelAnimationFrame(waiting);
    waiting = requestAnimationFrame(() => draw());
  });
  window.addEventListener("beforeprint", () => draw(kPaperWidth));
  window.addEventListener("afterprint", () => draw());
  document.documentElement.dataset.state = "ready";
} catch (error) {
  const fault = document.getElementById("fault");
  fault.textContent = `The report could not be drawn: ${error}`;
  fault.hidden = false;
  document.documentElement.dataset.state = "failed";
}
