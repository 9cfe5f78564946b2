// Icons, drawn as strokes of 24 × 24. Decoration only: buttons carry their names in words.

function stroke(path: string): string {
  return `<svg viewBox="0 0 24 24" width="20" height="20" fill="none" stroke="currentColor" stroke-width="1.8" stroke-linecap="round" stroke-linejoin="round" aria-hidden="true">${path}</svg>`;
}
function solid(path: string): string {
  return `<svg viewBox="0 0 24 24" width="20" height="20" fill="currentColor" aria-hidden="true">${path}</svg>`;
}

export const icons = {
  play: solid('<path d="M7 4.5v15l12-7.5z"/>'),
  pause: solid('<path d="M6 5h4v14H6zM14 5h4v14h-4z"/>'),
  back: solid('<path d="M17 5v14L8 12zM5 5h2v14H5z"/>'),
  forward: solid('<path d="M7 5v14l9-7zM17 5h2v14h-2z"/>'),
  first: solid('<path d="M19 5v14l-7-7zM12 5v14l-7-7zM3 5h2v14H3z"/>'),
  last: solid('<path d="M5 5v14l7-7zM12 5v14l7-7zM19 5h2v14h-2z"/>'),
  loop: stroke('<path d="M17 3l3 3-3 3M20 6H8a4 4 0 0 0-4 4v1M7 21l-3-3 3-3M4 18h12a4 4 0 0 0 4-4v-1"/>'),
  fit: stroke('<path d="M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5"/><rect x="9" y="9" width="6" height="6" rx="1"/>'),
  plus: stroke('<path d="M12 5v14M5 12h14"/>'),
  minus: stroke('<path d="M5 12h14"/>'),
  mesh: stroke('<path d="M4 4h16v16H4zM4 12h16M12 4v16"/>'),
  arrows: stroke('<path d="M4 20L13 11M13 17v-6H7M15 9l5-5M20 9V4h-5"/>'),
  section: stroke('<path d="M4 8l8-4 8 4v8l-8 4-8-4z"/><path d="M8 6v12l8 4V10z" fill="currentColor" fill-opacity=".35"/>'),
  measure: stroke('<path d="M3 8h18v8H3zM7 8v3M11 8v4M15 8v3M19 8v4"/>'),
  link: stroke('<path d="M10 14a4 4 0 0 0 6 0l3-3a4 4 0 0 0-6-6l-1 1M14 10a4 4 0 0 0-6 0l-3 3a4 4 0 0 0 6 6l1-1"/>'),
  camera: stroke('<path d="M4 8h3l2-3h6l2 3h3v11H4z"/><circle cx="12" cy="13" r="3.5"/>'),
  export: stroke('<path d="M12 4v11M7.5 11L12 15.5 16.5 11M4 20h16"/>'),
  theme: stroke('<circle cx="12" cy="12" r="8"/><path d="M12 4a8 8 0 0 1 0 16z" fill="currentColor"/>'),
  help: stroke('<circle cx="12" cy="12" r="9"/><path d="M9.5 9.5a2.5 2.5 0 1 1 3.6 2.2c-.8.4-1.1.9-1.1 1.8M12 17v.1"/>'),
  panel: stroke('<rect x="3" y="4" width="18" height="16" rx="2"/><path d="M15 4v16"/>'),
  close: stroke('<path d="M6 6l12 12M18 6L6 18"/>'),
  stop: solid('<rect x="6" y="6" width="12" height="12" rx="1"/>'),
  keep: stroke('<path d="M5 4h11l3 3v13H5zM8 4v5h7V4M8 20v-6h8v6"/>'),
};
