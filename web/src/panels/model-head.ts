// What stands over the page of the model that is open: its name and size, and all of it as a file.

import * as api from "../api/client";
import type { Job } from "../api/types";
import { download, h } from "../dom";
import type { Session } from "../session";
import { texts } from "../texts";
import { bare } from "../units";

export function modelHead(name: HTMLElement, actions: HTMLElement, session: Session): void {
  const all = h("button", { type: "button", hidden: true, click: session.guarded(() => exportAll(session)) }, texts.model.exportAll);
  actions.append(all);
  const tell = (): void => {
    const { model, unit } = session;
    all.hidden = model?.status !== "ready";
    document.title = model ? `${model.file_name} – QueryCAD` : "QueryCAD";
    const shape = model?.summary?.shape;
    const size = shape
      ? texts.model.size(`${shape.extents.map((length) => bare(length, unit)).join(" × ")} ${unit}`, model.summary!.body_count, shape.face_count)
      : model?.status === "reading"
        ? texts.model.pending
        : "";
    name.replaceChildren(...(model ? [h("strong", {}, model.file_name), h("span", { class: "quiet" }, ` ${size}`)] : []));
  };
  session.on("model", tell);
  session.on("unit", tell);
}

/** Everything that the service knows of the model, as one JSON file: summary, description, parts, answers. */
async function exportAll(session: Session): Promise<void> {
  const { model, unit } = session;
  if (!model) return;
  const answers: Job[] = [];
  for (let total = 1; answers.length < total; ) {
    const page = await api.answers(model.id, answers.length);
    if (!page.items.length) break;
    answers.push(...page.items);
    total = page.total;
  }
  const [description, parts] = await Promise.all([api.describe(model.id, unit), api.allParts(model.id)]);
  download(`${model.file_name}.json`, JSON.stringify({ model, description, parts, answers }, null, 1), "application/json");
}
