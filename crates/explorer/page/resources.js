// Addresses of the page's files, and settings from its server.
//
// A single-file page first sets `globalThis.explorerFiles`, a map from names such as
// `models/house.glb` to addresses. In other pages, names are relative to the page.

/** Returns the address of one of the page's files. @param {string} path */
export const resourceUrl = (path) => globalThis.explorerFiles?.[path] ?? new URL(path, document.baseURI).href;

/**
 * The settings that `alberti explore` wrote into the page; empty on a static host.
 * @type {{native?: boolean, wasm?: boolean, files?: string[], open?: string}}
 */
export const server = JSON.parse(document.querySelector('meta[name="explorer-server"]').content || '{}');
