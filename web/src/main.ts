// Puts the page together: who is told what, and what the address says.

import * as api from "./api/client";
import { byId, h } from "./dom";
import { linkTo, readPlace, writePlace } from "./link";
import { Bodies } from "./panels/bodies";
import { Conversation } from "./panels/conversation";
import { DescriptionPanel } from "./panels/description";
import { Files } from "./panels/files";
import { modelHead } from "./panels/model-head";
import { SelectionBox } from "./panels/selection";
import { SignIn } from "./panels/sign-in";
import { Tables } from "./panels/tables";
import { Tabs } from "./panels/tabs";
import { Tools } from "./panels/tools";
import { Session } from "./session";
import { texts } from "./texts";
import { Gizmo } from "./viewer/gizmo";
import { readModel } from "./viewer/model";
import { Overlay } from "./viewer/overlay";
import { Viewer } from "./viewer/viewer";

const session = new Session();
/** What the address said when the page was loaded. */
const wanted = readPlace();
const place = { ...wanted };
let opening = 0;

const panel = (): HTMLElement => {
  const made = h("div", { hidden: true });
  byId("panels").append(made);
  return made;
};
const panels = { ask: panel(), holes: panel(), bodies: panel(), description: panel() };

const conversation = new Conversation(panels.ask, session, (job) => tell({ answer: job }));
const selection = new SelectionBox(conversation.top, session);
const choose = (ids: readonly string[]): Promise<void> => selection.choose(ids);
const holes = new Tables(panels.holes, session, ["holes", "slots", "bosses", "edges", "bends", "patterns", "fasteners"], choose);
const bill = new Tables(panels.bodies, session, ["bodies"], choose);
const description = new DescriptionPanel(panels.description, session, choose, (questions) => conversation.suggest(questions));
const tabs = new Tabs(
  byId("tabs"),
  [
    { id: "ask", name: texts.tabs.ask, panel: panels.ask, shown: () => {} },
    { id: "holes", name: texts.tabs.holes, panel: panels.holes, shown: session.guarded(() => holes.show()) },
    { id: "bodies", name: texts.tabs.bodies, panel: panels.bodies, shown: session.guarded(() => bill.show()) },
    { id: "description", name: texts.tabs.description, panel: panels.description, shown: session.guarded(() => description.load()) },
  ],
  (tab) => tell({ tab: tab === "ask" ? "" : tab }),
);

modelHead(byId("model-name"), byId("model-actions"), session);
const files = new Files(byId("files"), session, (id) => session.guarded(() => open(id))());
new Bodies(byId("files"), session);
const signIn = new SignIn(byId<HTMLFormElement>("sign-in"), start);
byId("model-actions").append(h("button", { type: "button", id: "sign-out", hidden: !api.hasKey(), click: () => signIn.out() }, texts.signIn.out));
trouble();
view();
byId("skip").addEventListener("click", (event) => {
  event.preventDefault(); // the address says what is shown, and no place on the page
  byId("question").focus();
});
window.addEventListener("hashchange", session.guarded(follow));
tabs.show(place.tab ?? "ask");
session.guarded(start)();

/** Remembers in the address what is shown. */
function tell(change: typeof place, fresh = false): void {
  Object.assign(place, change);
  delete place.view; // a link to a view is made when one is asked for
  writePlace(place, fresh);
}

/** What the address says is shown: at the start, and when the user goes back. */
async function follow(): Promise<void> {
  const now = readPlace();
  const changed = now.model !== session.model?.id;
  Object.assign(place, { model: "", answer: "", tab: "" }, now);
  if (changed && now.model) await open(now.model, now.answer, now.view);
  else if (changed) session.open(undefined);
  tabs.show(now.tab ?? "ask");
}

async function start(): Promise<void> {
  byId("sign-out").hidden = !api.hasKey();
  await files.refresh();
  if (wanted.model) await open(wanted.model, wanted.answer, wanted.view);
}

/** Opens a model: its answers at once, its view and description as they come. */
async function open(id: string, answer?: string, pose?: string): Promise<void> {
  const mine = (opening += 1);
  if (place.model !== id || answer !== place.answer) tell({ model: id, answer: answer ?? "" }, place.model !== id);
  const model = await api.model(id).catch((error: unknown) => {
    if (mine === opening) session.open(undefined);
    throw error;
  });
  if (mine !== opening) return;
  session.open(model);
  if (model.failure) session.emit("trouble", `${model.file_name}: ${texts.files.failed(model.failure.message)}`);
  const ready = model.status === "ready";
  await Promise.all([
    ready ? draw(id, pose) : Promise.resolve(session.viewer?.show(undefined)),
    conversation.show(answer),
    ...(ready ? [description.load(), panels.holes.hidden ? undefined : holes.show(), panels.bodies.hidden ? undefined : bill.show()] : []),
  ]);
}

async function draw(id: string, pose?: string): Promise<void> {
  const { viewer } = session;
  if (!viewer) return;
  const waits = byId("view-message");
  viewer.show(undefined);
  waits.textContent = texts.view.loading;
  try {
    const model = await readModel(await api.glb(id));
    if (session.model?.id !== id) return model.dispose();
    viewer.show(model);
    if (pose) viewer.pose = pose;
    session.relight();
    session.emit("drawn", undefined);
    waits.textContent = "";
  } catch (error) {
    waits.textContent = error instanceof Error ? error.message : String(error);
    throw error;
  }
}

/** The 3D view, where the browser can show one. */
function view(): void {
  const holder = byId("view");
  const message = h("p", { id: "view-message", class: "quiet" }, texts.view.empty);
  holder.append(message);
  let viewer: Viewer;
  try {
    viewer = new Viewer(holder);
  } catch {
    message.textContent = texts.noWebGl;
    return;
  }
  const overlay = new Overlay(holder, viewer);
  session.viewer = viewer;
  session.overlay = overlay;
  const link = (): string => linkTo({ ...place, view: viewer.pose });
  const tools = new Tools(byId("tools"), byId("view-foot"), session, viewer, link);
  const gizmo = new Gizmo(holder, viewer);
  viewer.onFrame = () => {
    overlay.draw();
    gizmo.draw();
  };
  viewer.onClick = (hit, x, y) => {
    if (!tools.took(hit, x, y)) session.guarded(() => selection.click(hit))();
  };
  const label = (): void => {
    const { size } = viewer.lit;
    const lit = size ? `${size} faces` : "";
    viewer.canvas.setAttribute("aria-label", texts.view.label(session.model?.file_name ?? "", lit));
  };
  viewer.canvas.setAttribute("role", "application");
  session.on("model", (model) => {
    if (!model) {
      viewer.show(undefined);
      message.textContent = texts.view.empty;
    }
    label();
  });
  session.on("lit", label);
  label();
  // For scripts and tests: what is lit, what is seen at a place, how fast it is drawn.
  Object.assign(window, { querycad: viewer });
}

function trouble(): void {
  const place = byId("trouble");
  const close = h("button", { type: "button", class: "plain", click: () => (place.hidden = true) }, texts.dismiss);
  session.on("trouble", (text) => {
    place.replaceChildren(h("span", {}, text), close);
    place.hidden = !text;
  });
}
