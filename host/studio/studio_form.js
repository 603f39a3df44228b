// The case as a form: every key with its unit, default, bounds and meaning. It is another view of the text: a field that is
// changed changes its line, and nothing else of the text.

const form = {schemas: {}, ofStudy: false, stated: [], values: {}, faults: [], shown: new Map()};

const schemaNow = () => form.schemas[form.ofStudy];

/// What a schema allows, where it allows several forms: that of a list of tables, or the first.
const formOf = schema => (schema.anyOf ? schema.anyOf.find(s => s.type === "array" && s.items && s.items.properties) || schema.anyOf[0] : schema);
const isTable = schema => formOf(schema).type === "object" && formOf(schema).properties !== undefined;
const isList = schema => formOf(schema).type === "array" && formOf(schema).items !== undefined && formOf(schema).items.properties !== undefined;

/// How many tables a list has in the text.
function countOf(list) {
  const places = form.stated.map(s => s.key.match(`^${list}\\[(\\d+)\\]`)).filter(m => m).map(m => Number(m[1]));
  return places.length ? Math.max(...places) + 1 : 0;
}

/// The tables of the form: those of a schema, those within, and each table of a list.
function tablesOf(schema, path, title, tables) {
  const keys = [], within = [];
  Object.entries(formOf(schema).properties).forEach(([name, value]) => {
    const full = path ? `${path}.${name}` : name;
    if (isTable(value)) within.push(() => tablesOf(value, full, title ? `${title}.${name}` : name, tables));
    else if (isList(value))
      within.push(() => d3.range(countOf(full)).forEach(i => {
        const one = `${full}[${i}]`, called = statedText(`${one}.name`);
        tablesOf(formOf(value).items, one, `${title ? title + "." : ""}${name} ${called ? JSON.parse(called) : i + 1}`, tables);
      }));
    else keys.push({name, path: full, schema: value});
  });
  // A table of keys that are the user's choice, as [set] of a study, shows those that are stated.
  if (formOf(schema).additionalProperties === true)
    form.stated.filter(s => s.key.startsWith(`${path}.`)).forEach(s => keys.push({name: s.key.slice(path.length + 1), path: s.key, schema: {}}));
  if (keys.length > 0) tables.push({path, title: title || (form.ofStudy ? "the study" : "the case"), keys});
  within.forEach(go => go());
}

const statedText = key => (form.stated.find(s => s.key === key) || {}).text;

const unlinked = text => (text || "").replace(/\[([^\]]*)\]\([^)]*\)/g, "$1");

/// A text in which words of a case stand between backticks.
function addWords(box, text) {
  text.split("`").forEach((part, i) => part && (i % 2 === 1 ? add(box, "code", part) : box.appendChild(document.createTextNode(part))));
}

/// The kinds of value that a key may have, and the words among them.
function kindsOf(schema) {
  const all = (schema.anyOf || [schema]), words = [];
  all.forEach(s => words.push(...(s.enum || []), ...(s.const !== undefined ? [s.const] : [])));
  const types = new Set(all.map(s => s.type || (s.enum || s.const !== undefined ? "string" : "any")));
  return {words, types, description: unlinked(all[0].description || schema.description), default: all[0].default, from: all[0].minimum ?? all[0].exclusiveMinimum, to: all[0].maximum};
}

/// What is typed into a field as TOML; null takes the key out.
function tomlOf(text, kinds) {
  const typedText = text.trim();
  if (typedText === "") return null;
  if (kinds.words.includes(typedText)) return JSON.stringify(typedText);
  if (kinds.types.has("string") && !(kinds.types.has("number") && isNumber(Number(typedText)))) return JSON.stringify(typedText);
  return typedText;
}

/// A value of the text as it stands in a field.
function fieldOf(toml) {
  if (toml === undefined) return "";
  try {
    const value = JSON.parse(toml);
    return typeof value === "string" ? value : toml;
  } catch (_) {
    return toml;
  }
}

async function change(key, value) {
  const {text} = await ask("/api/edit", {text: at("text").value, key, value});
  setText(text);
}

function fieldFor(row, key, kinds, shown) {
  const choices = kinds.types.has("boolean") ? ["true", "false"] : kinds.types.size === 1 && kinds.words.length > 0 ? kinds.words : null;
  const now = fieldOf(shown.stated);
  const otherwise = fieldOf(shown.value) || (kinds.default !== undefined ? String(kinds.default) : "");
  let field = null;
  if (choices) {
    field = add(row, "select");
    add(field, "option", otherwise ? `${otherwise} (not stated)` : "not stated").value = "";
    choices.forEach(word => { add(field, "option", String(word)).value = word; });
    field.value = now;
  } else {
    field = add(row, "input");
    field.autocomplete = "off";
    if (kinds.types.has("number") || kinds.types.has("integer")) field.inputMode = "decimal";
    field.value = now;
    field.placeholder = otherwise;
  }
  field.id = `key-${key.path}`;
  field.dataset.key = key.path;
  field.setAttribute("aria-describedby", `${field.id}-meaning`);
  field.addEventListener("change", tried(() => change(key.path, kinds.types.has("boolean") ? field.value || null : tomlOf(field.value, kinds))));
  return field;
}

function rowFor(box, key) {
  const kinds = kindsOf(key.schema), fault = form.faults.find(f => f.key === key.path);
  const shown = {stated: statedText(key.path), value: form.values[key.path]};
  const row = add(box, "div", null, `key${fault ? " " + fault.kind : ""}${shown.stated === undefined ? "" : " stated"}`);
  const label = add(row, "label", key.name);
  const field = fieldFor(row, key, kinds, shown);
  label.htmlFor = field.id;
  const bounds = [kinds.from !== undefined ? `from ${kinds.from}` : "", kinds.to !== undefined ? `to ${kinds.to}` : ""].filter(b => b).join(" ");
  const meaning = add(row, "small");
  addWords(meaning, [kinds.description, bounds, fault ? `${fault.text}. ${fault.cure || ""}` : ""].filter(t => t).join(" · "));
  meaning.id = `${field.id}-meaning`;
}

const sought = () => at("form-find").value.trim().toLowerCase();

const namedSo = key => key.path.toLowerCase().includes(sought());

/// The keys of a table that have what is sought in their name or meaning, those by name first.
const fitting = table => table.keys.filter(namedSo)
  .concat(table.keys.filter(k => !namedSo(k) && kindsOf(k.schema).description.toLowerCase().includes(sought())));

function fill(group, table) {
  if (group.filled) return;
  group.filled = true;
  const found = sought(), keys = fitting(table);
  const stated = keys.filter(k => statedText(k.path) !== undefined), others = keys.filter(k => statedText(k.path) === undefined);
  if (found) return keys.forEach(key => rowFor(group, key));
  stated.forEach(key => rowFor(group, key));
  if (others.length === 0) return;
  if (stated.length === 0) return others.forEach(key => rowFor(group, key));
  const more = details(group, `${table.path}/more`, `${others.length} more key${others.length === 1 ? "" : "s"}`, false);
  const show = () => { if (more.open && !more.filled) { more.filled = true; others.forEach(key => rowFor(more, key)); } };
  more.addEventListener("toggle", show);
  show();
}

/// A part that opens and closes, and stays so when the form is made anew.
function details(box, name, title, usual) {
  const part = add(box, "details");
  add(part, "summary", title);
  part.open = form.shown.has(name) ? form.shown.get(name) : usual;
  part.addEventListener("toggle", () => { if (!sought()) form.shown.set(name, part.open); });
  return part;
}

function drawForm() {
  if (at("form").hidden || !schemaNow()) return;
  const box = at("form-groups"), active = document.activeElement, key = active && active.dataset ? active.dataset.key : null;
  box.textContent = "";
  const tables = [];
  tablesOf(schemaNow(), "", "", tables);
  const found = sought();
  if (found) tables.sort((a, b) => b.keys.some(namedSo) - a.keys.some(namedSo));
  tables.forEach(table => {
    if (fitting(table).length === 0) return;
    const stated = table.keys.filter(k => statedText(k.path) !== undefined).length;
    const group = details(box, table.path, `${table.title}${stated > 0 ? ` · ${stated} stated` : ""}`, stated > 0);
    if (table.keys.some(k => form.faults.some(f => f.key === k.path && f.kind === "error")) || found) group.open = true;
    group.addEventListener("toggle", () => group.open && fill(group, table));
    if (group.open) fill(group, table);
  });
  if (key && document.getElementById(`key-${key}`)) document.getElementById(`key-${key}`).focus();
}

/// What the check has found, for the form.
async function showForm(found, faults, ofStudy) {
  form.stated = faults.some(f => f.text.startsWith("not TOML")) ? form.stated : found.stated;
  if (!faults.some(f => f.kind === "error")) form.values = found.values || {};
  Object.assign(form, {faults, ofStudy});
  if (!at("form").hidden) await fetchKeys();
  drawForm();
}

/// The lists of tables that a schema has, those within a table too.
function listsOf(schema, path) {
  return d3.merge(Object.entries(formOf(schema).properties).map(([name, value]) => {
    const full = path ? `${path}.${name}` : name;
    return isList(value) ? [full] : isTable(value) ? listsOf(value, full) : [];
  }));
}

async function fetchKeys() {
  const ofStudy = form.ofStudy;
  if (!form.schemas[ofStudy]) form.schemas[ofStudy] = await ask(`/api/keys${ofStudy ? "?study=1" : ""}`);
  const lists = at("form-list");
  lists.textContent = "";
  add(lists, "option", "choose").value = "";
  listsOf(schemaNow(), "").forEach(name => add(lists, "option", name));
}

async function showAs(asForm) {
  if (asForm) await fetchKeys();
  at("edit").hidden = asForm;
  at("form").hidden = !asForm;
  at("as-text").setAttribute("aria-pressed", String(!asForm));
  at("as-form").setAttribute("aria-pressed", String(asForm));
  drawForm();
}

/// The key with which a new table begins, where that is not its name.
const kFirstKeys = {
  axis: ["key", "contact.friction"],
  "calibrate.target": ["figure", "dose.mean_kg"], "design.goal": ["figure", "dose.mean_kg"],
  "calibrate.parameter": ["key", "contact.friction"], "design.parameter": ["key", "contact.friction"],
};

async function addTable() {
  const list = at("form-list").value;
  if (!list) return;
  at("form-list").value = "";
  const one = `${list}[${countOf(list)}]`;
  form.shown.set(one, true);
  const [key, value] = kFirstKeys[list] || ["name", `${list}-${countOf(list) + 1}`];
  await change(`${one}.${key}`, JSON.stringify(value));
}

function beginForm() {
  at("as-text").addEventListener("click", tried(() => showAs(false)));
  at("as-form").addEventListener("click", tried(() => showAs(true)));
  at("form-find").addEventListener("input", drawForm);
  at("form-list").addEventListener("change", tried(addTable));
}
