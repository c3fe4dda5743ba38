// Where the service asks for a key: a field for it, in place of an error.

import * as api from "../api/client";
import { h } from "../dom";
import { texts } from "../texts";

export class SignIn {
  private readonly key = h("input", { type: "password", id: "key", autocomplete: "current-password", required: true, "aria-describedby": "key-hint" });
  private readonly hint = h("span", { id: "key-hint", role: "status" }, texts.signIn.hint);
  private tried = false;

  constructor(
    private readonly form: HTMLFormElement,
    private readonly signedIn: () => Promise<void>,
  ) {
    form.append(h("label", { for: "key" }, texts.signIn.label), this.key, h("button", { class: "primary" }, texts.signIn.button), this.hint);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.submit();
    });
    api.whenUnknown(() => this.ask());
  }

  /** Forgets the key and asks for another. */
  out(): void {
    api.useKey("");
    this.tried = false;
    location.reload();
  }

  private ask(): void {
    const wrong = this.tried || api.hasKey();
    this.hint.textContent = wrong ? texts.signIn.wrong : texts.signIn.hint;
    this.key.setAttribute("aria-invalid", String(wrong));
    if (!this.form.hidden) return;
    this.form.hidden = false;
    this.key.focus();
  }

  private async submit(): Promise<void> {
    this.tried = true;
    api.useKey(this.key.value.trim());
    try {
      await api.models();
    } catch {
      api.useKey("");
      return; // `whenUnknown` has said so
    }
    this.key.value = "";
    this.form.hidden = true;
    this.tried = false;
    await this.signedIn();
  }
}
