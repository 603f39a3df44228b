// The workbench. All that it knows it asks of the server, which asks the program.

const at = id => document.getElementById(id);

function say(text, bad) {
  at("message").textContent = text;
  at("message").className = bad ? "bad" : "";
}

/// What the server has answered; its words if it refuses.
async function answerIn(response) {
  const text = await response.text();
  let answer = null;
  try {
    answer = JSON.parse(text);
  } catch (_) {
    throw new Error(text.trim() || `the workbench answered ${response.status}`);
  }
  if (!response.ok) throw Object.assign(new Error(answer.error), {status: response.status});
  return answer;
}

async function ask(path, body) {
  const post = {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(body)};
  return answerIn(await fetch(path, body === undefined ? {} : post));
}

const about = name => `name=${encodeURIComponent(name)}`;
const ofRun = run => `run=${encodeURIComponent(run)}`;

/// Does something that can fail, and tells the fault.
const tried = make => async (...given) => {
  try {
    await make(...given);
  } catch (error) {
    say(error.message, true);
  }
};
