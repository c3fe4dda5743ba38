// The models: those that are there, and files on their way, each with its own name, progress and outcome.

import * as api from "../api/client";
import type { ModelResource } from "../api/types";
import { announce, h } from "../dom";
import type { Session } from "../session";
import { texts } from "../texts";
import { bytes } from "../units";

const LOOK_MS = 400;
/** Files sent at the same time; the others wait in the browser. */
const AT_ONCE = 2;

interface Upload {
  readonly name: string;
  readonly size: number;
  readonly stop: AbortController;
  sent: number;
  /** Models that were listed when it was chosen: none of them is this file's. */
  readonly before: ReadonlySet<string>;
  failed?: string;
}

export class Files {
  private readonly list = h("ul", { class: "files" });
  private readonly input = h("input", { type: "file", id: "file", accept: ".step,.stp,.p21,.stpz,.igs,.iges,.brep,.zip,.stl,.obj,.3mf", multiple: true });
  private readonly uploads: Upload[] = [];
  private models: readonly ModelResource[] = [];
  private readonly watched = new Set<string>();

  constructor(
    section: HTMLElement,
    private readonly session: Session,
    private readonly open: (id: string) => void,
  ) {
    const drop = h("label", { class: "drop", for: "file" }, h("strong", {}, texts.files.choose), h("span", {}, texts.files.drop), this.input);
    section.append(drop, this.list);
    this.input.addEventListener("change", () => {
      this.take([...(this.input.files ?? [])]);
      this.input.value = "";
    });
    for (const name of ["dragenter", "dragover"]) {
      document.addEventListener(name, (event) => {
        event.preventDefault();
        drop.classList.add("over");
      });
    }
    document.addEventListener("dragleave", (event) => {
      if (event.relatedTarget === null) drop.classList.remove("over");
    });
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      drop.classList.remove("over");
      this.take([...(event.dataTransfer?.files ?? [])]);
    });
    // another tab may have added or deleted some
    document.addEventListener("visibilitychange", () => {
      if (!document.hidden) this.session.guarded(() => this.refresh())();
    });
    session.on("model", () => this.render());
  }

  /** Asks again which models there are. */
  async refresh(): Promise<void> {
    this.models = (await api.models()).items;
    this.models.filter((model) => model.status === "reading").forEach((model) => void this.watch(model.id));
    this.render();
  }

  /** Sends files, some at a time; one that fails says so in its own row and stops no other. */
  private take(files: readonly File[]): void {
    if (!files.length) return;
    const before = new Set(this.models.map((model) => model.id));
    const waiting = files.map((file, place) => {
      const upload: Upload = { name: file.name, size: file.size, stop: new AbortController(), sent: 0, before };
      this.uploads.unshift(upload);
      return { file, upload, place };
    });
    this.render();
    /** What came of each, in the order chosen: the id of its model, empty where it was refused. */
    const came: string[] = [];
    let opened = false;
    const next = async (): Promise<void> => {
      for (let one = waiting.shift(); one; one = waiting.shift()) {
        came[one.place] = (await this.send(one.file, one.upload)) ?? "";
        const first = files.findIndex((_, place) => came[place] !== "");
        const model = came[first];
        if (opened || !model) continue; // the first that is taken is opened, though others may be faster
        opened = true;
        this.open(model);
      }
    };
    void Promise.all(Array.from({ length: AT_ONCE }, next)).then(() => {
      const good = came.filter(Boolean).length;
      announce(texts.files.outcome(good, files.length - good));
    });
  }

  /** Sends one file; the id of its model, or undefined, and its row says why. */
  private async send(file: File, upload: Upload): Promise<string | undefined> {
    const progress = (share: number): void => {
      upload.sent = share;
      this.render();
    };
    try {
      upload.stop.signal.throwIfAborted();
      const { id } = await api.upload(file, progress, upload.stop.signal);
      this.uploads.splice(this.uploads.indexOf(upload), 1);
      await this.refresh();
      return id;
    } catch (error) {
      const stopped = error instanceof DOMException && error.name === "AbortError";
      upload.failed = stopped ? texts.files.stopped : texts.files.refused(error instanceof Error ? error.message : String(error));
      this.render();
      return undefined;
    }
  }

  /** Follows a file while it is read, to its end. */
  private async watch(id: string): Promise<void> {
    if (this.watched.has(id)) return;
    this.watched.add(id);
    try {
      for (;;) {
        const model = await api.model(id);
        this.models = this.models.map((each) => (each.id === id ? model : each));
        this.render();
        if (model.status !== "reading") {
          announce(`${model.file_name}: ${model.failure ? texts.files.failed(model.failure.message) : texts.files.ready}`);
          if (this.session.model?.id === id) this.open(id);
          return;
        }
        await new Promise((resolve) => setTimeout(resolve, LOOK_MS));
      }
    } catch {
      await this.refresh().catch(() => {}); // deleted meanwhile, or the service is away
    } finally {
      this.watched.delete(id);
    }
  }

  private readonly remove = async (model: ModelResource, ask: boolean): Promise<void> => {
    if (ask && !confirm(texts.files.sure(model.file_name))) return;
    await api.deleteModel(model.id);
    if (this.session.model?.id === model.id) this.session.open(undefined);
    await this.refresh();
  };

  private render(): void {
    const focused = document.activeElement?.getAttribute("data-focus");
    const arrived = (upload: Upload): boolean => // its model is listed before the answer to the upload is here
      this.models.some((model) => !upload.before.has(model.id) && model.file_name === upload.name && model.size_bytes === upload.size);
    const uploads = this.uploads.filter((upload) => upload.failed !== undefined || !arrived(upload));
    const rows = [...uploads.map((upload) => this.uploadRow(upload)), ...this.models.map((model) => this.modelRow(model))];
    this.list.replaceChildren(...(rows.length ? rows : [h("li", { class: "quiet" }, texts.files.empty)]));
    if (focused) this.list.querySelector<HTMLElement>(`[data-focus="${focused}"]`)?.focus();
  }

  private uploadRow(upload: Upload): HTMLElement {
    const stop = (): void => {
      if (upload.failed) this.uploads.splice(this.uploads.indexOf(upload), 1);
      else upload.stop.abort();
      this.render();
    };
    const label = upload.failed ? texts.files.dismiss(upload.name) : texts.files.cancel(upload.name);
    return h(
      "li",
      { class: upload.failed ? "file failed" : "file" },
      h("div", { class: "file-name" }, h("span", {}, upload.name), h("small", {}, upload.failed ?? texts.files.uploading(Math.round(upload.sent * 100)))),
      h("button", { type: "button", class: "plain", "aria-label": label, title: label, click: stop }, "×"),
      !upload.failed && h("progress", { max: 1, value: upload.sent, "aria-label": upload.name }),
    );
  }

  private modelRow(model: ModelResource): HTMLElement {
    const reading = model.status === "reading";
    const label = (reading ? texts.files.cancel : texts.files.remove)(model.file_name);
    const status = model.failure
      ? texts.files.failed(model.failure.message)
      : !reading
        ? bytes(model.size_bytes)
        : model.stage
          ? texts.files.stage[model.stage]
          : texts.files.ahead(model.ahead);
    return h(
      "li",
      { class: model.failure ? "file failed" : "file" },
      h(
        "button",
        {
          type: "button",
          class: "file-name",
          "data-focus": model.id,
          "aria-current": model.id === this.session.model?.id ? "true" : undefined,
          click: () => this.open(model.id),
        },
        h("span", {}, model.file_name),
        h("small", {}, status),
      ),
      h(
        "button",
        {
          type: "button",
          class: "plain",
          "aria-label": label,
          title: label,
          "data-focus": `remove-${model.id}`,
          click: this.session.guarded(() => this.remove(model, !reading && !model.failure)),
        },
        "×",
      ),
      reading && h("progress", { max: 5, value: stagesBegun(model), "aria-label": model.file_name }),
    );
  }
}

/** How many of the five stages of reading have begun? */
function stagesBegun(model: ModelResource): number {
  return model.stage ? Object.keys(texts.files.stage).indexOf(model.stage) + 0.5 : 0;
}
