// The page's behaviour: uploads, the list of models, questions with their steps as server-sent events.

const byId = (id) => document.getElementById(id);
let chosen = null;

const headers = () => {
  const key = sessionStorage.getItem("key");
  return key ? { Authorization: `Bearer ${key}` } : {};
};

class Problem extends Error {}

async function call(path, options = {}) {
  const response = await fetch(path, { ...options, headers: { ...headers(), ...options.headers } });
  if (response.ok) return response;
  if (response.status === 401) byId("key-form").hidden = false;
  const problem = await response.json().catch(() => ({}));
  throw new Problem(problem.detail || problem.title || response.statusText);
}

const trouble = (error) => {
  byId("trouble").textContent = error?.message ?? "";
  byId("trouble").hidden = !error;
};

const guarded = (work) => async (...given) => {
  try {
    trouble(null);
    await work(...given);
  } catch (error) {
    trouble(error);
  }
};

// Pictures are fetched, not linked: an <img> cannot send the key.
async function show(image, path, text) {
  const blob = await (await call(path)).blob();
  URL.revokeObjectURL(image.src);
  image.src = URL.createObjectURL(blob);
  image.alt = text;
  image.hidden = false;
}

function upload(file) {
  // XMLHttpRequest: fetch does not tell how much has been sent
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    const form = new FormData();
    form.append("file", file);
    request.open("POST", "v1/models");
    request.setRequestHeader("Prefer", "wait=50");
    Object.entries(headers()).forEach(([name, value]) => request.setRequestHeader(name, value));
    request.responseType = "json";
    request.upload.onprogress = (event) => { byId("upload").value = event.loaded / event.total; };
    request.onerror = () => reject(new Problem("the service does not answer"));
    request.onload = () => {
      if (request.status < 300) return resolve(request.response);
      if (request.status === 401) byId("key-form").hidden = false;
      reject(new Problem(request.response?.detail || request.response?.title || request.statusText));
    };
    request.send(form);
  });
}

async function uploadAll(files) {
  byId("upload").hidden = false;
  try {
    for (const file of files) await choose((await upload(file)).id);
  } finally {
    byId("upload").hidden = true;
    byId("file").value = "";
  }
}

async function listModels() {
  const page = await (await call("v1/models?limit=50")).json();
  byId("models").replaceChildren(...page.items.map((model) => {
    const item = document.createElement("li");
    const button = document.createElement("button");
    button.textContent = `${model.file_name} (${model.status})`;
    button.setAttribute("aria-current", String(model.id === chosen));
    button.onclick = guarded(() => choose(model.id));
    item.append(button);
    return item;
  }));
}

const mm = (metres) => (metres * 1000).toLocaleString("en", { maximumSignificantDigits: 5 });

async function choose(id) {
  chosen = id;
  byId("answers").replaceChildren();
  await listModels();
  const model = await (await call(`v1/models/${id}`, { headers: { Prefer: "wait=50" } })).json();
  if (chosen !== id) return;
  byId("model").hidden = false;
  byId("model-title").textContent = model.file_name;
  byId("view").hidden = true;
  byId("ask").hidden = model.status === "failed";
  byId("summary").textContent = model.failure?.message ?? "being read …";
  if (model.status === "ready") {
    const { shape, body_count: bodies, part_counts: parts, warnings } = model.summary;
    byId("summary").textContent = [
      `${shape.extents.map(mm).join(" × ")} mm`,
      `${bodies} ${bodies === 1 ? "body" : "bodies"}, ${shape.face_count} faces`,
      ...Object.entries(parts).map(([kind, count]) => `${count} × ${kind}`),
      ...warnings,
    ].join("\n");
    await show(byId("view"), `v1/models/${id}/views/isometric?width=640&height=480`, `${model.file_name}, isometric view`);
  }
  await listModels();
  const history = await (await call(`v1/models/${id}/answers?limit=20`)).json();
  byId("answers").replaceChildren(...history.items.map((job) => {
    const item = entry(job);
    if (job.record) fill(item, job, job.record, false); else follow(item, job);
    return item;
  }));
}

function entry(job) {
  const item = byId("answer-template").content.cloneNode(true).firstElementChild;
  item.querySelector("h3").textContent = job.question;
  item.querySelector(".cancel").onclick = guarded(() => call(`v1/jobs/${job.id}/cancel`, { method: "POST" }));
  return item;
}

function notes(record) {
  const sure = record.confidence == null ? "" : ` (confidence ${record.confidence.toFixed(2)})`;
  const understood = record.answer && record.understood_as ? [`understood as: ${record.understood_as}${sure}`] : [];
  return [...understood, ...(record.warnings ?? [])];
}

function fill(item, job, record, fresh = true) {
  item.querySelector(".cancel").hidden = true;
  const answer = item.querySelector(".answer");
  const nearest = record.failure?.nearest?.length ? ` Known here: ${record.failure.nearest.join(", ")}.` : "";
  answer.textContent = record.answer?.text ?? `${record.failure.message.replace(/\.?$/, ".")}${nearest}`;
  answer.classList.toggle("failed", !record.answer);
  item.querySelector(".notes").replaceChildren(...notes(record).map((text) => line(text)));
  const spent = Object.entries(record.timings_ms ?? {}).map(([step, ms]) => `${step} ${ms.toFixed(0)} ms`);
  item.querySelector(".steps").textContent = spent.join(" · ");
  if (record.code) {
    item.querySelector("details").hidden = false;
    item.querySelector("pre").textContent = record.code;
    item.querySelector(".parts").replaceChildren(...(record.parts ?? []).map((part) => line(`${part.id}: ${part.label}`)));
  }
  if (record.answer) {
    const draw = () => show(
      item.querySelector(".picture"), `v1/models/${job.model}/answers/${job.id}/picture`, "the parts that the answer rests on",
    ).catch(trouble);
    // those of earlier answers are drawn when somebody looks: drawing takes seconds
    if (fresh) draw(); else item.querySelector("details").addEventListener("toggle", draw, { once: true });
  }
}

function line(text) {
  const item = document.createElement("li");
  item.textContent = text;
  return item;
}

const STEPS = { queued: "waiting", started: "begun", program: "program written", ran: "program run", waiting: "waiting" };

async function follow(item, job) {
  const seen = [];
  let last = "";
  for (let tries = 0; tries < 20; tries += 1) {
    try {
      const response = await call(`v1/jobs/${job.id}/events`, { headers: last ? { "Last-Event-ID": last } : {} });
      for await (const event of events(response.body)) {
        last = event.id;
        if (event.kind === "done") return fill(item, job, event.data.record);
        seen.push(STEPS[event.kind] ?? event.kind);
        item.querySelector(".steps").textContent = `${seen.join(" · ")} …`;
      }
    } catch (error) {
      if (error instanceof Problem) return trouble(error);
    }
    await new Promise((resolve) => setTimeout(resolve, 1000));
  }
}

// EventSource cannot send the key either: the stream is read by hand (WHATWG HTML, server-sent events).
async function* events(body) {
  const reader = body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (;;) {
    const { value, done } = await reader.read();
    if (done) return;
    text += value;
    const blocks = text.split("\n\n");
    text = blocks.pop();
    for (const block of blocks) {
      const fields = Object.fromEntries(block.split("\n").map((row) => [row.split(":", 1)[0], row.slice(row.indexOf(":") + 1).trimStart()]));
      if (fields.data) yield { kind: fields.event, id: fields.id, data: JSON.parse(fields.data) };
    }
  }
}

byId("file").onchange = guarded((event) => uploadAll(event.target.files));
byId("drop").ondragover = (event) => { event.preventDefault(); byId("drop").classList.add("over"); };
byId("drop").ondragleave = () => byId("drop").classList.remove("over");
byId("drop").ondrop = guarded((event) => {
  event.preventDefault();
  byId("drop").classList.remove("over");
  return uploadAll(event.dataTransfer.files);
});
byId("key-form").onsubmit = guarded(async (event) => {
  event.preventDefault();
  sessionStorage.setItem("key", byId("key").value.trim());
  await listModels();
  byId("key-form").hidden = true;
});
byId("ask").onsubmit = guarded(async (event) => {
  event.preventDefault();
  const body = JSON.stringify({ question: byId("question").value, unit: byId("unit").value });
  const options = {
    method: "POST", body, headers: { "Content-Type": "application/json", "Idempotency-Key": `page-${Date.now()}-${Math.random()}` },
  };
  const job = await (await call(`v1/models/${chosen}/questions`, options)).json();
  const item = entry(job);
  byId("answers").prepend(item);
  await follow(item, job);
});
guarded(listModels)();
