// The service's HTTP interface, as this page uses it.

import { texts } from "../texts";
import type {
  Description,
  Face,
  Job,
  JobEvent,
  LengthUnit,
  ModelResource,
  Page,
  Part,
  RunOutcome,
  Selection,
  Table,
  TableKind,
} from "./types";

const KEY = "querycad-key";
const WAIT_S = 20;
const PAUSE_MS = 1000;
/** So many failures in a row, a second apart, and the service counts as away. */
const TRIES = 20;
const IDS_AT_ONCE = 200;

/** The service refused; `message` is for the user. */
export class Problem extends Error {
  constructor(
    readonly status: number,
    message: string,
    readonly retryable = false,
  ) {
    super(message);
  }
}

/** Called when a request was refused for want of a valid API key. */
let onUnknown: () => void = () => {};

export function whenUnknown(listener: () => void): void {
  onUnknown = listener;
}

export function useKey(key: string): void {
  if (key) sessionStorage.setItem(KEY, key);
  else sessionStorage.removeItem(KEY);
}

export const hasKey = (): boolean => sessionStorage.getItem(KEY) !== null;

function authorization(): Record<string, string> {
  const key = sessionStorage.getItem(KEY);
  return key ? { Authorization: `Bearer ${key}` } : {};
}

function problemOf(status: number, body: unknown): Problem {
  const { detail, title, retryable } = (body ?? {}) as { detail?: string; title?: string; retryable?: boolean };
  if (status === 401) onUnknown();
  return new Problem(status, detail || title || texts.noSense(status), retryable ?? false);
}

/** A response that is none of an error. Throws a Problem, of status 0 where the service cannot be reached. */
async function call(path: string, options: RequestInit = {}): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(path, { ...options, headers: { ...authorization(), ...(options.headers as object) } });
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    throw new Problem(0, texts.away, true);
  }
  if (response.ok) return response;
  throw problemOf(response.status, await response.json().catch(() => null));
}

const get = async <T>(path: string, headers: Record<string, string> = {}): Promise<T> =>
  (await call(path, { headers })).json() as Promise<T>;

const post = async <T>(path: string, body: unknown, headers: Record<string, string> = {}): Promise<T> => {
  const given = { method: "POST", body: JSON.stringify(body), headers: { "Content-Type": "application/json", ...headers } };
  return (await call(path, given)).json() as Promise<T>;
};

const of = (model: string): string => `v1/models/${model}`;

export const models = (): Promise<Page<ModelResource>> => get("v1/models?limit=200");

/** A model; `wait`: once its file has been read, or after some seconds. */
export const model = (id: string, wait = false): Promise<ModelResource> =>
  get(of(id), wait ? { Prefer: `wait=${WAIT_S}` } : {});

export async function deleteModel(id: string): Promise<void> {
  await call(of(id), { method: "DELETE" });
}

export const glb = async (id: string): Promise<ArrayBuffer> => (await call(`${of(id)}/glb`)).arrayBuffer();

export const faces = (id: string, ids: readonly number[]): Promise<Face[]> =>
  get(`${of(id)}/faces?${ids.map((face) => `id=${face}`).join("&")}`);

/** The parts of these ids, in no order. */
export async function parts(id: string, ids: readonly string[]): Promise<Part[]> {
  const found: Part[] = [];
  for (let at = 0; at < ids.length; at += IDS_AT_ONCE) {
    const some = ids.slice(at, at + IDS_AT_ONCE).map((part) => `id=${encodeURIComponent(part)}`);
    found.push(...(await get<Page<Part>>(`${of(id)}/parts?limit=${IDS_AT_ONCE}&${some.join("&")}`)).items);
  }
  return found;
}

export async function allParts(id: string): Promise<Part[]> {
  const found: Part[] = [];
  for (;;) {
    const page = await get<Page<Part>>(`${of(id)}/parts?limit=1000&offset=${found.length}`);
    found.push(...page.items);
    if (!page.items.length || found.length >= page.total) return found;
  }
}

export const table = (id: string, kind: TableKind, grouped: boolean, unit: LengthUnit): Promise<Table> =>
  get(`${of(id)}/tables/${kind}?grouped=${grouped}&unit=${unit}`);

export const tableCsv = async (id: string, kind: TableKind, grouped: boolean, unit: LengthUnit): Promise<string> =>
  (await call(`${of(id)}/tables/${kind}?format=csv&grouped=${grouped}&unit=${unit}`)).text();

export const describe = (id: string, unit: LengthUnit): Promise<Description> => get(`${of(id)}/description?unit=${unit}`);

export const answers = (id: string, offset = 0): Promise<Page<Job>> => get(`${of(id)}/answers?limit=50&offset=${offset}`);

/** The parts that a program's answer rests on: of another reading, say. */
export const run = (id: string, code: string): Promise<RunOutcome> => post(`${of(id)}/programs`, { code });

export const picture = async (id: string, job: string): Promise<Blob> => (await call(`${of(id)}/answers/${job}/picture`)).blob();

export interface Asked {
  question: string;
  unit: LengthUnit;
  selection?: Selection;
  context: readonly string[];
}

export const ask = (id: string, asked: Asked): Promise<Job> =>
  post(`${of(id)}/questions`, asked, { "Idempotency-Key": crypto.randomUUID?.() ?? `${Date.now()}-${Math.random()}` });

export const job = (id: string): Promise<Job> => get(`v1/jobs/${id}`);

export const cancel = (id: string): Promise<Job> => post(`v1/jobs/${id}/cancel`, {});

/** Sends a file; `progress` is told the share that has been sent. Aborted by the signal, it throws an AbortError. */
export function upload(file: File, progress: (share: number) => void, signal: AbortSignal): Promise<ModelResource> {
  // XMLHttpRequest: fetch does not tell how much has been sent
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    const form = new FormData();
    form.append("file", file);
    request.open("POST", "v1/models");
    Object.entries(authorization()).forEach(([name, value]) => request.setRequestHeader(name, value));
    request.responseType = "json";
    request.upload.onprogress = (event) => progress(event.lengthComputable ? event.loaded / event.total : 0);
    request.onerror = () => reject(new Problem(0, texts.away, true));
    request.onabort = () => reject(new DOMException("stopped", "AbortError"));
    request.onload = () => {
      if (request.status < 300) resolve(request.response as ModelResource);
      else reject(problemOf(request.status, request.response));
    };
    signal.addEventListener("abort", () => request.abort());
    request.send(form);
  });
}

/** What happens to a question, to its end, across lost connections. Throws a Problem where it cannot be told. */
export async function* follow(id: string, signal: AbortSignal): AsyncGenerator<JobEvent> {
  let last = "";
  for (let failures = 0; failures < TRIES; ) {
    try {
      const response = await call(`v1/jobs/${id}/events`, { signal, headers: last ? { "Last-Event-ID": last } : {} });
      if (response.status === 204 || !response.body) return;
      for await (const event of events(response.body)) {
        [last, failures] = [event.id, 0];
        yield event.data;
        if (event.data.kind === "done") return;
      }
    } catch (error) {
      if (signal.aborted || (error instanceof Problem && !error.retryable)) throw error;
    }
    failures += 1;
    await new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
  }
  throw new Problem(0, texts.away, true);
}

/** Server-sent events, read by hand (WHATWG HTML, 9.2): EventSource cannot send a key. */
async function* events(body: ReadableStream<Uint8Array>): AsyncGenerator<{ id: string; data: JobEvent }> {
  const reader = body.pipeThrough(new TextDecoderStream() as unknown as TransformStream<Uint8Array, string>).getReader();
  let text = "";
  for (;;) {
    const { value, done } = await reader.read();
    if (done) return;
    text += value;
    const blocks = text.split("\n\n");
    text = blocks.pop() ?? "";
    for (const block of blocks) {
      const rows = block.split("\n").map((row): [string, string] => {
        const colon = row.indexOf(":");
        return [row.slice(0, colon), row.slice(colon + 1).trimStart()];
      });
      const fields = new Map(rows);
      const data = fields.get("data");
      if (data) yield { id: fields.get("id") ?? "", data: JSON.parse(data) as JobEvent };
    }
  }
}
