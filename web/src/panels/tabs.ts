// Tabs as the ARIA patterns have them: one tab stop, arrow keys between them.

import { h } from "../dom";

export interface Tab {
  readonly id: string;
  readonly name: string;
  readonly panel: HTMLElement;
  /** Called when it is shown. */
  readonly shown: () => void;
}

export class Tabs {
  private readonly buttons = new Map<string, HTMLButtonElement>();

  constructor(
    bar: HTMLElement,
    private readonly tabs: readonly Tab[],
    private readonly changed: (id: string) => void,
  ) {
    tabs.forEach((tab, index) => {
      tab.panel.id = `panel-${tab.id}`;
      tab.panel.setAttribute("role", "tabpanel");
      tab.panel.setAttribute("aria-labelledby", `tab-${tab.id}`);
      const button = h(
        "button",
        { type: "button", role: "tab", id: `tab-${tab.id}`, "data-tab": tab.id, "aria-controls": tab.panel.id, click: () => this.show(tab.id) },
        tab.name,
      );
      button.addEventListener("keydown", (event) => {
        const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        if (!step) return;
        const next = tabs[(index + step + tabs.length) % tabs.length]!;
        this.show(next.id);
        this.buttons.get(next.id)?.focus();
      });
      this.buttons.set(tab.id, button);
      bar.append(button);
    });
  }

  show(id: string): void {
    const wanted = this.tabs.find((tab) => tab.id === id) ?? this.tabs[0]!;
    for (const tab of this.tabs) {
      const chosen = tab === wanted;
      tab.panel.hidden = !chosen;
      const button = this.buttons.get(tab.id);
      button?.setAttribute("aria-selected", String(chosen));
      button?.setAttribute("tabindex", chosen ? "0" : "-1");
    }
    this.changed(wanted.id);
    wanted.shown();
  }
}
