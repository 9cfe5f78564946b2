// How the page is built: one script and one style sheet with fixed names into ../bundle, which is committed
// and compiled into the program. The same sources give the same bytes: no hashes in names, no source maps, no
// dates. The licences of three and uPlot stand at the script's head.
import { readFileSync } from "node:fs";
import { defineConfig, type Plugin } from "vite";

/** Puts the licences of what is built in before the script, after everything else was shortened. */
function licences(names: string[]): Plugin {
  const texts = names.map((name) => `${name}\n\n${readFileSync(new URL(`node_modules/${name}/LICENSE`, import.meta.url), "utf8").replace(/\r/g, "").replace(/\*\//g, "* /").trim()}\n`);
  return {
    name: "licences",
    enforce: "post",
    generateBundle(_options, bundle) {
      for (const file of Object.values(bundle)) if (file.type === "chunk") file.code = `/*!\nThis script contains:\n\n${texts.join("\n")}*/\n${file.code}`;
    },
  };
}

export default defineConfig({
  base: "./",
  publicDir: "public",
  plugins: [licences(["three", "uplot"])],
  build: {
    outDir: "../bundle",
    emptyOutDir: true,
    target: "es2022",
    sourcemap: false,
    cssCodeSplit: false,
    modulePreload: false,
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 2000,
    rollupOptions: {
      output: {
        codeSplitting: false,
        entryFileNames: "app.js",
        assetFileNames: (asset) => (asset.names.some((name) => name.endsWith(".css")) ? "app.css" : "[name][extname]"),
      },
    },
  },
});
