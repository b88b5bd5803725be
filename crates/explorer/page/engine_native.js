// The engine of `alberti explore --native`: the server computes the answer to `GET compute?QUERY`.

/** @param {(path: string) => string} urlOf */
export async function startEngine(urlOf) {
  const address = urlOf('compute');
  return {
    async answer(query) {
      let response;
      try {
        response = await fetch(`${address}?${query}`);
      } catch {
        throw { code: 'no-server', message: 'The server does not respond.', help: 'Start `alberti explore` again.' };
      }
      const contentType = response.headers.get('content-type');
      if (contentType === 'application/problem+json') throw await response.json();
      if (!response.ok) {
        const message = `The server answered ${response.status}: ${await response.text()}`;
        throw { code: 'server', message, help: 'Start `alberti explore` again.' };
      }
      return { contentType, bytes: new Uint8Array(await response.arrayBuffer()) };
    },
    addFile(name) {
      throw {
        code: 'native-files',
        message: `The server does not accept files from the browser, so ${name} cannot be opened here.`,
        help: 'Run `alberti explore --native MODEL`.',
      };
    },
  };
}
