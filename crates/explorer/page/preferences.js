// User preferences (language and theme) and the choice of where pictures are computed.

import { byId } from './dom.js';
import { server } from './resources.js';
import { LANGUAGES, currentLanguage, setLanguage } from './texts.js';

/** Whether the server computes pictures: `?native`, or without WebAssembly. */
export function chooseNative() {
  if (!server.native) return false;
  return new URLSearchParams(location.search).has('native') || !server.wasm || typeof WebAssembly !== 'object';
}

/** Remembers a choice if the browser allows it. */
const remember = (key, value) => {
  try {
    localStorage.setItem(key, value);
  } catch {
    // Private windows may not allow it. The choice then lasts for this page.
  }
};

const recall = (key) => {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
};

/** Sets the language and theme with their selectors. @param {() => void} languageChanged */
export function preferences(languageChanged) {
  const ofLink = new URLSearchParams(location.hash.slice(1)).get('lang');
  const ofBrowser = navigator.languages.map((one) => one.slice(0, 2)).find((one) => LANGUAGES.includes(one));
  setLanguage(ofLink ?? recall('language') ?? ofBrowser ?? 'en');
  byId('language').value = currentLanguage();
  byId('language').addEventListener('change', () => {
    setLanguage(byId('language').value);
    remember('language', currentLanguage());
    languageChanged();
  });
  const setTheme = (theme) => (document.documentElement.dataset.theme = theme);
  byId('theme').value = recall('theme') ?? 'auto';
  setTheme(byId('theme').value || 'auto');
  byId('theme').addEventListener('change', () => {
    setTheme(byId('theme').value);
    remember('theme', byId('theme').value);
  });
  languageChanged();
}
