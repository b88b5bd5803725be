// Where the files of the page are, and what its server says.
//
// A page in one file sets `globalThis.explorerFiles`, from the names of files (`worker.js`, `models/house.glb`, …)
// to addresses of their contents, before the modules run. Otherwise names are relative to the page.

/** The address of a file of the page. @param {string} path */
export const resourceUrl = (path) => globalThis.explorerFiles?.[path] ?? new URL(path, document.baseURI).href;

/**
 * What `alberti explore` wrote into the page; empty on a static host.
 * @type {{native?: boolean, wasm?: boolean, files?: string[], open?: string}}
 */
export const server = JSON.parse(document.querySelector('meta[name="explorer-server"]').content || '{}');
