// Run at the end of a page: what the function probe() finds is written into the document.

const sleep = () => new Promise(resolve => setTimeout(resolve, 50));
const figureOf = title => Array.from(document.querySelectorAll("figure")).find(f => f.querySelector("h3").textContent === title);

/// Sets a control as a reader would.
function setControl(element, key, value, event) {
  element[key] = value;
  element.dispatchEvent(new Event(event));
}

setTimeout(() => probe().catch(error => ({state: `probe: ${error}`})).then(found => {
  const box = document.createElement("pre");
  box.id = "probe";
  box.textContent = JSON.stringify(found);
  document.body.appendChild(box);
}), 0);
