"use strict";
// Asks for the state of the watch a few times a second and draws it. The page
// keeps the last minute itself.
const kPeriod = 200, kHistory = 60;
const history = [];
let shown = "";

function byId(id) { return document.getElementById(id); }

function cell(row, text) {
  const element = row.insertCell();
  element.textContent = text;
  return element;
}

function short(value) {
  return value === null ? "" : Number(value).toPrecision(3).replace("-", "\u2212");
}

function makeRows(joints) {
  const body = byId("joints");
  if (body.rows.length === joints.length) return;
  body.replaceChildren();
  for (const joint of joints) {
    const row = body.insertRow();
    cell(row, joint.name);
    cell(row, "");
    cell(row, "");
    const canvas = document.createElement("canvas");
    canvas.setAttribute("role", "img");
    row.insertCell().append(canvas);
  }
}

function drawPlot(canvas, j, end) {
  const scale = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * scale;
  canvas.height = canvas.clientHeight * scale;
  const style = getComputedStyle(document.documentElement);
  const context = canvas.getContext("2d");
  let top = 1e-9;
  for (const { joints } of history) {
    top = Math.max(top, Math.abs(joints[j].residual), 1.2 * (joints[j].limit || 0));
  }
  const x = time => (1 - (end - time) / kHistory) * canvas.width;
  const y = value => (.5 - .48 * value / top) * canvas.height;
  const line = (key, sign, colour, dash) => {
    context.beginPath();
    context.strokeStyle = style.getPropertyValue(colour);
    context.lineWidth = scale;
    context.setLineDash(dash);
    let begun = false;
    for (const { time, joints } of history) {
      if (joints[j][key] === null) continue;
      if (begun) context.lineTo(x(time), y(sign * joints[j][key]));
      else context.moveTo(x(time), y(sign * joints[j][key]));
      begun = true;
    }
    context.stroke();
  };
  line("limit", 1, "--limit", [4 * scale, 3 * scale]);
  line("limit", -1, "--limit", [4 * scale, 3 * scale]);
  line("residual", 1, "--line", []);
}

function drawJoints(state) {
  makeRows(state.joints);
  state.joints.forEach((joint, j) => {
    const row = byId("joints").rows[j];
    const over = joint.limit !== null && Math.abs(joint.residual) > joint.limit;
    row.className = over ? "over" : "";
    row.cells[1].textContent = short(joint.residual) + " " + joint.unit;
    row.cells[2].textContent = joint.limit === null ? "learning" : short(joint.limit) + " " + joint.unit;
    const canvas = row.cells[3].firstChild;
    canvas.setAttribute("aria-label", `${joint.name}: residual ${row.cells[1].textContent}, ` +
                        `limit ${row.cells[2].textContent}`);
    drawPlot(canvas, j, state.time);
  });
}

function drawChanges(changes) {
  const body = byId("changes");
  body.replaceChildren();
  for (const change of changes) {
    const row = body.insertRow();
    cell(row, change.name);
    cell(row, short(change.value));
    cell(row, `${short(change.value - 1.96 * change.stddev)} to ` +
              `${short(change.value + 1.96 * change.stddev)}`);
    cell(row, change.unit);
  }
  if (changes.length === 0) cell(body.insertRow(), "nothing");
}

function drawEvents(events) {
  const lines = events.map(event => event.line);
  if (lines.join("\n") === shown) return;
  shown = lines.join("\n");
  byId("events").replaceChildren(...lines.reverse().map(line => {
    const item = document.createElement("li");
    item.textContent = line.trim();
    return item;
  }));
}

function draw(state) {
  byId("robot").textContent = state.robot;
  drawEvents(state.events);
  if (state.time === null) return;
  if (history.length === 0 || state.time > history[history.length - 1].time) history.push(state);
  while (history[0].time < state.time - kHistory) history.shift();
  byId("status").textContent = `${state.time.toFixed(1)} s: ` +
    (state.learning ? "learning what is normal" : state.contact ? "contact" : "watching");
  byId("status").className = state.contact ? "alarm" : "";
  drawJoints(state);
  drawChanges(state.changes);
  document.documentElement.dataset.ready = "true";
}

async function ask() {
  try {
    const response = await fetch("state.json");
    draw(await response.json());
    setTimeout(ask, kPeriod);
  } catch {
    byId("status").textContent += ", which has ended";
    document.documentElement.dataset.ended = "true";
  }
}

ask();
