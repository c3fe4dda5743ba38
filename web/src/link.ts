// What the address says: which model, which answer, how it is seen. A link to it shows the same to whoever opens it.

export interface Place {
  model?: string;
  answer?: string;
  tab?: string;
  view?: string;
}

const NAMES = ["model", "answer", "tab", "view"] as const;

export function readPlace(): Place {
  const given = new URLSearchParams(location.hash.slice(1));
  const place: Place = {};
  for (const name of NAMES) {
    const value = given.get(name);
    if (value) place[name] = value;
  }
  return place;
}

const written = (place: Place): string => {
  const told = NAMES.flatMap((name) => (place[name] ? [`${name}=${encodeURIComponent(place[name]).replaceAll("%2C", ",")}`] : []));
  return `#${told.join("&")}`;
};

/** Makes the address say so; `fresh`: as a new step of the browser's history. */
export function writePlace(place: Place, fresh = false): void {
  const hash = written(place);
  if (hash === location.hash || (hash === "#" && !location.hash)) return;
  history[fresh ? "pushState" : "replaceState"](null, "", hash === "#" ? location.pathname : hash);
}

export const linkTo = (place: Place): string => new URL(written(place), location.href).href;
