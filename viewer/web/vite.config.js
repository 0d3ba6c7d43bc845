import { readFileSync } from 'node:fs';
import { defineConfig } from 'vite';

/** The page is a copy of these libraries, so it carries their licences. */
const licences = {
  name: 'licences',
  generateBundle() {
    const texts = ['three', 'uplot'].map(
      (library) => `${library}\n\n${readFileSync(`node_modules/${library}/LICENSE`, 'utf8')}`);
    this.emitFile({ type: 'asset', fileName: 'licences.txt', source: texts.join('\n\n') });
  },
};

export default defineConfig({
  base: './',
  plugins: [licences],
  build: {
    outDir: process.env.TERN_PAGE_DIR ?? '../../build/viewer-page',
    emptyOutDir: true,
    chunkSizeWarningLimit: 2000,
    target: 'es2022',
  },
});
