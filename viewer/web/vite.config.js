import { defineConfig } from 'vite';

export default defineConfig({
  base: './',
  build: {
    outDir: process.env.TERN_PAGE_DIR ?? '../../build/viewer-page',
    emptyOutDir: true,
    chunkSizeWarningLimit: 2000,
  },
});
