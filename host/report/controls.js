// The controls of a figure, and the line that tells the moment it shows.

function control(parent, label, element) {
  const box = add(parent, "label", null, "control");
  add(box, "span", label);
  box.appendChild(element);
  return element;
}

function choice(parent, label, names, changed) {
  const select = control(parent, label, document.createElement("select"));
  names.forEach(name => add(select, "option", name));
  select.addEventListener("change", () => changed(select.selectedIndex));
  return select;
}

function button(parent, text, label, pressed) {
  const element = add(parent, "button", text);
  element.type = "button";
  element.setAttribute("aria-label", label);
  element.title = label;
  element.addEventListener("click", pressed);
  return element;
}

function slider(parent, label, most, changed) {
  const element = document.createElement("input");
  Object.assign(element, {type: "range", min: 0, max: most, step: 1, value: 0});
  element.setAttribute("aria-label", label);
  element.addEventListener("input", () => changed(Number(element.value)));
  parent.appendChild(element);
  return element;
}

const kPhases = ["settling", "the coil turns", "at rest", "the coil turns back"];

/// The moment of a picture as text: time [s], dose (0: none so far) and number of the phase.
const momentText = (time, dose, phase) => `t = ${time.toFixed(3)} s${dose > 0 ? `, dose ${dose}` : ""}, ${kPhases[phase]}`;
