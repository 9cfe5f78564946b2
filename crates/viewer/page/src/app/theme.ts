// Light and dark: as the system says, or as chosen. The choice stands in `data-theme` of the document;
// colours are in theme.css.

import type { Theme } from "./view";

const system = window.matchMedia("(prefers-color-scheme: dark)");

export function isDark(theme: Theme): boolean {
  return theme === "dark" || (theme === "auto" && system.matches);
}
export function apply(theme: Theme): void {
  document.documentElement.dataset["theme"] = isDark(theme) ? "dark" : "light";
}
export function onSystem(listener: () => void): void {
  system.addEventListener("change", listener);
}
/** A colour of theme.css as it is now. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
