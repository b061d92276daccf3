"""The page of the viewfinder: plain HTML and script, nothing from another machine."""

PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>dmpcpp record</title>
<style nonce="{{nonce}}">
body { font: 16px system-ui, sans-serif; margin: 1rem; background: #14171a; color: #e8eaed; }
main { display: flex; flex-wrap: wrap; gap: 1rem; }
figure { margin: 0; position: relative; }
video { width: 640px; max-width: 48vw; display: block; background: #000; }
canvas.over { position: absolute; left: 0; top: 0; width: 100%; pointer-events: none; }
figcaption { padding: .3rem 0; min-height: 1.4em; }
#arm { background: #1d2126; }
button { font: inherit; padding: .5rem 1.2rem; margin-right: .6rem; }
.good { color: #7bd88f; } .bad { color: #ff8f7a; }
</style></head><body>
<h1>dmpcpp record</h1>
<p id="state">asking for the camera ..</p>
<p><button id="start" disabled>Record</button><button id="stop" disabled>Stop and save</button>
<span>Nothing leaves this machine. One hand, open, palm or back to the cameras.</span></p>
<main id="views"></main>
<script nonce="{{nonce}}">
"use strict";
const settings = {{settings}};
const state = text => { document.getElementById("state").textContent = text; };
const views = [];
function view(k, stream) {
  const figure = document.createElement("figure"), video = document.createElement("video");
  const over = document.createElement("canvas"), caption = document.createElement("figcaption");
  over.className = "over"; video.muted = true; video.playsInline = true; video.srcObject = stream;
  figure.append(video, over, caption); document.getElementById("views").append(figure); video.play();
  const small = document.createElement("canvas");
  views.push({k, stream, video, over, caption, small, chunks: [], recorder: null, frames: 0, found: 0});
}
function draw(v, answer) {
  const w = v.over.width = v.video.clientWidth, h = v.over.height = v.video.clientHeight, c = v.over.getContext("2d");
  c.clearRect(0, 0, w, h);
  v.frames += 1;
  if (!answer.found) { v.caption.textContent = settings.names[v.k] + ": no hand"; v.caption.className = "bad"; return; }
  v.found += 1;
  const good = answer.flat > 0.5, p = answer.points;
  c.strokeStyle = c.fillStyle = good ? "#7bd88f" : "#ff8f7a"; c.lineWidth = 2;
  for (const [a, b] of settings.bones) {
    c.beginPath(); c.moveTo(p[a][0] * w, p[a][1] * h); c.lineTo(p[b][0] * w, p[b][1] * h); c.stroke();
  }
  const which = answer.right > 0.5 ? "right hand" : "left hand, or a mirrored picture";
  v.caption.textContent = settings.names[v.k] + ": " + which + (good ? "" : ": turn the palm to the camera");
  v.caption.className = good ? "good" : "bad";
  if (answer.arm) arm(answer.arm);
}
function arm(points) {
  let canvas = document.getElementById("arm");
  if (!canvas) {
    canvas = document.createElement("canvas"); canvas.id = "arm"; canvas.width = canvas.height = 360;
    document.getElementById("views").append(canvas);
  }
  const c = canvas.getContext("2d"), n = 360;
  c.clearRect(0, 0, n, n); c.strokeStyle = "#8ab4f8"; c.fillStyle = "#e8eaed"; c.lineWidth = 6; c.lineJoin = "round";
  c.beginPath(); points.forEach(([x, y], k) => k ? c.lineTo(x * n, y * n) : c.moveTo(x * n, y * n)); c.stroke();
  for (const [x, y] of points) { c.beginPath(); c.arc(x * n, y * n, 4, 0, 7); c.fill(); }
}
const to = (path, k) => path + "?key=" + encodeURIComponent(settings.key) + "&camera=" + k;
async function watch(v) {
  for (;;) {
    await new Promise(done => setTimeout(done, 60));
    if (!v.video.videoWidth) continue;
    v.small.width = 640; v.small.height = Math.round(640 * v.video.videoHeight / v.video.videoWidth);
    v.small.getContext("2d").drawImage(v.video, 0, 0, v.small.width, v.small.height);
    const jpeg = await new Promise(done => v.small.toBlob(done, "image/jpeg", 0.8));
    try { draw(v, await (await fetch(to("/frame", v.k), {method: "POST", body: jpeg})).json()); } catch { return; }
  }
}
function record() {
  for (const v of views) {
    v.chunks = []; v.recorder = new MediaRecorder(v.stream, {mimeType: "video/webm", videoBitsPerSecond: 8e6});
    v.recorder.ondataavailable = event => v.chunks.push(event.data); v.recorder.start();
  }
  document.getElementById("start").disabled = true; document.getElementById("stop").disabled = false;
  state("recording: make the motion, then stop");
}
async function save() {
  document.getElementById("stop").disabled = true; state("saving ..");
  await Promise.all(views.map(v => new Promise(done => { v.recorder.onstop = done; v.recorder.stop(); })));
  for (const v of views) {
    const video = new Blob(v.chunks, {type: "video/webm"});
    const answer = await fetch(to("/video", v.k), {method: "POST", body: video});
    if (!answer.ok) { state("could not be saved: " + answer.status); return; }
  }
  state("saved. The terminal goes on.");
}
async function begin() {
  try {
    const size = {width: {ideal: 1280}, height: {ideal: 720}, frameRate: {ideal: 30}};
    const first = await navigator.mediaDevices.getUserMedia({video: size, audio: false});
    const own = first.getVideoTracks()[0].getSettings().deviceId;
    const devices = await navigator.mediaDevices.enumerateDevices();
    const others = devices.filter(d => d.kind === "videoinput" && d.deviceId !== own);
    view(0, first);
    if (settings.count > 1) {
      if (!others.length) { state("one camera only: connect a second, or start dmpcpp record --cameras 1"); return; }
      const wanted = {...size, deviceId: {exact: others[0].deviceId}};
      view(1, await navigator.mediaDevices.getUserMedia({video: wanted, audio: false}));
    }
  } catch (error) { state("no camera: " + error.name + ". Allow it in the browser, or close what uses it."); return; }
  views.forEach(watch);
  document.getElementById("start").disabled = false; state("ready");
}
document.getElementById("start").onclick = record; document.getElementById("stop").onclick = save;
begin();
</script></body></html>
"""
