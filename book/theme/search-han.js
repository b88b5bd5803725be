// Search in Chinese. mdBook's index treats text between spaces as a word, and drops Han characters when it trims words. On
// Chinese pages, the documents are therefore indexed again when the search is first opened: Latin words unchanged, and runs
// of Han characters as overlapping pairs. So 透视除法 finds every page with 透视, 视除 and 除法.
'use strict';

(function searchHan() {
  const HAN = /[\u3400-\u9fff\uf900-\ufaff]/;
  const WORDS = /[\u3400-\u9fff\uf900-\ufaff]+|[\p{L}\p{N}_]+/gu;

  /** Returns the terms of a text: lower-case Latin words, pairs of Han characters, and isolated Han characters. */
  function tokenize(text) {
    const terms = [];
    for (const [word] of String(text ?? '').toLowerCase().matchAll(WORDS)) {
      if (!HAN.test(word) || word.length === 1) terms.push(word);
      else for (let at = 0; at + 1 < word.length; at += 1) terms.push(word.slice(at, at + 2));
    }
    return terms;
  }

  /** Builds an index of the documents in a dump, with the terms that `tokenize` returns. */
  function rebuild(elasticlunr, dump) {
    elasticlunr.tokenizer = tokenize;
    const index = new elasticlunr.Index();
    index.setRef('id');
    for (const field of dump.fields) index.addField(field);
    for (const [id, doc] of Object.entries(dump.documentStore.docs)) index.addDoc({ ...doc, id });
    return index;
  }

  /** Returns the part of a text around the first occurrence of any of the terms. */
  function teaser(text, terms) {
    const plain = text.toLowerCase();
    const places = terms.map((term) => plain.indexOf(term)).filter((at) => at >= 0);
    const start = Math.max(0, Math.min(...(places.length > 0 ? places : [0])) - 30);
    return `${start > 0 ? '…' : ''}${text.slice(start, start + 120)}${start + 120 < text.length ? '…' : ''}`;
  }

  function install(elasticlunr) {
    const load = elasticlunr.Index.load;
    elasticlunr.Index.load = function loadHan(dump) {
      if (dump.documentStore === undefined) return load(dump);
      const index = rebuild(elasticlunr, dump);
      const search = index.search.bind(index);
      // mdBook's teaser counts words between spaces, so pass it a short text with spaces around the search terms.
      index.search = (query, options) => {
        const words = query.toLowerCase().split(/\s+/).filter((word) => word !== '');
        return search(query, options).map((found) => {
          let body = teaser(found.doc.body, words);
          for (const word of words) body = body.split(word).join(` ${word} `);
          return { ...found, doc: { ...found.doc, body } };
        });
      };
      return index;
    };
  }

  const TEXTS = {
    '#mdbook-searchbar': ['placeholder', '搜索本书…'],
    '#mdbook-search-toggle': ['title', '搜索 (/)'],
    '#mdbook-sidebar-toggle': ['title', '目录'],
    '#mdbook-theme-toggle': ['title', '主题'],
    '.print-button': ['title', '打印'],
  };

  /** Translates the labels that mdBook provides only in English. */
  function translateInterface() {
    for (const [selector, [name, value]] of Object.entries(TEXTS)) {
      document.querySelector(selector)?.closest('a, button, label, input')?.setAttribute(name, value);
    }
    const header = document.querySelector('#mdbook-searchresults-header');
    const countInChinese = () => {
      const count = header.innerText.match(/^(\d+|No) search results?/);
      if (count) header.innerText = count[1] === 'No' ? '没有找到。' : `找到 ${count[1]} 处：`;
    };
    if (!header) return;
    // With `?search=` in the address, results may appear before this script runs.
    countInChinese();
    new MutationObserver(countInChinese).observe(header, { childList: true });
  }

  if (!document.documentElement.lang.startsWith('zh')) return;
  // The page loads this script twice: in its head, before the search loads its index, and at its end, to translate the labels.
  if (document.body) {
    translateInterface();
    return;
  }
  let library;
  Object.defineProperty(window, 'elasticlunr', {
    get: () => library,
    set: (value) => {
      library = value;
      install(value);
    },
  });
})();
