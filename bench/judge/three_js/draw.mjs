// Serves page.html, lets a headless Chromium draw it, and writes what it posts as FOLDER/<settings>/<light>.pfm.
//
// usage: node draw.mjs OPTIONS.json
// OPTIONS: three (folder of the npm package), scene (GLB file), out (folder), width, height, camera (index),
// settings (list of {name, map_size, bias, normal_bias, radius, type}), timed (frames).
import {spawn} from "node:child_process";
import {createReadStream, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {createServer} from "node:http";
import {tmpdir} from "node:os";
import path from "node:path";
import {setTimeout} from "node:timers/promises";
import {fileURLToPath} from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const options = JSON.parse(readFileSync(process.argv[2], "utf8"));
const kinds = {".html": "text/html", ".js": "text/javascript", ".glb": "model/gltf-binary"};
const limit_s = options.limit_s ?? 900;

const body_of = (request) => new Promise((resolve) => {
  const parts = [];
  request.on("data", (part) => parts.push(part)).on("end", () => resolve(Buffer.concat(parts)));
});

function write_visibility(url, floats) {
  const folder = path.join(options.out, url.searchParams.get("settings"));
  mkdirSync(folder, {recursive: true});
  const head = `Pf\n${options.width} ${options.height}\n-1.0\n`;
  writeFileSync(path.join(folder, `${url.searchParams.get("light")}.pfm`), Buffer.concat([Buffer.from(head), floats]));
}

function send_file(response, file) {
  response.setHeader("Content-Type", kinds[path.extname(file)] ?? "application/octet-stream");
  createReadStream(file).on("error", () => { response.statusCode = 404; response.end(); }).pipe(response);
}

const profile = mkdtempSync(path.join(tmpdir(), "gnomon-chromium-"));
let chromium;
const ended = new Promise((resolve) => {
  const server = createServer(async (request, response) => {
    const url = new URL(request.url, "http://localhost");
    if (request.method === "POST") {
      const body = await body_of(request);
      response.end();
      if (url.pathname === "/result") write_visibility(url, body);
      if (url.pathname === "/end") resolve(JSON.parse(body));
    } else if (url.pathname === "/options") response.end(JSON.stringify(options));
    else if (url.pathname === "/scene.glb") send_file(response, options.scene);
    else if (url.pathname.startsWith("/three/")) send_file(response, path.join(options.three, url.pathname.slice(7)));
    else send_file(response, path.join(here, path.basename(url.pathname)));
  });
  server.listen(0, "127.0.0.1", () => {
    chromium = spawn(options.chromium ?? "chromium",
      ["--headless", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
       "--disable-component-update", "--disable-sync", "--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist",
       `--user-data-dir=${profile}`, `http://127.0.0.1:${server.address().port}/page.html`], {stdio: "ignore", detached: true});
    chromium.on("error", (error) => resolve({error: `chromium: ${error.message}`}));
  });
  setTimeout(1000 * limit_s).then(() => resolve({error: `no answer within ${limit_s} s`}));
});
const end = await ended;
if (chromium?.pid && chromium.exitCode === null) {
  const gone = new Promise((resolve) => chromium.once("close", resolve));
  process.kill(-chromium.pid, "SIGKILL");  // its helpers, too: it leads a group of its own
  await gone;
}
await setTimeout(200);
rmSync(profile, {recursive: true, force: true});
console.log(JSON.stringify(end));
process.exit(end.error ? 1 : 0);
