'use strict';
const form = document.getElementById('filter');
const trials = [...document.querySelectorAll('details.trial')];
const shown = document.getElementById('shown');
const keys = [...form.querySelectorAll('select')].map(select => select.name);

function apply() {
  const words = form.words.value.toLowerCase().split(/\s+/).filter(Boolean);
  const fits = trial =>
    keys.every(key => !form[key].value || trial.dataset[key].split(' ').includes(form[key].value)) &&
    words.every(word => trial.querySelector('summary').textContent.toLowerCase().includes(word));
  let count = 0;
  for (const trial of trials) {
    trial.hidden = !fits(trial);
    count += trial.hidden ? 0 : 1;
  }
  shown.textContent = `${count} of ${trials.length} trials shown`;
}

form.addEventListener('input', apply);
form.addEventListener('submit', event => event.preventDefault());
apply();

// Centimetres, y up, as the home is told; SVG has y down.
const SVG = 'http://www.w3.org/2000/svg';

function put(parent, name, attributes, text) {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  parent.append(node);
  return node;
}

const points = corners => {
  const pairs = [];
  for (let i = 0; i < corners.length; i += 2) pairs.push(`${corners[i]},${-corners[i + 1]}`);
  return pairs.join(' ');
};

function middle(corners) {
  let x = 0, y = 0;
  for (let i = 0; i < corners.length; i += 2) { x += corners[i]; y += corners[i + 1]; }
  return [2 * x / corners.length, -2 * y / corners.length];
}

function drawHome(svg, home) {
  const xs = home.walls.flatMap(([x1, , x2]) => [x1, x2]), ys = home.walls.flatMap(([, y1, , y2]) => [y1, y2]);
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  svg.setAttribute('viewBox', `${left - 20} ${-high - 20} ${right - left + 40} ${high - low + 40}`);
  for (const [, corners] of home.pieces) put(svg, 'polygon', { class: 'true', points: points(corners) });
  for (const [x1, y1, x2, y2] of home.walls) put(svg, 'line', { class: 'wall', x1, y1: -y1, x2, y2: -y2 });
  for (const [name, x, y] of home.rooms) put(svg, 'text', { class: 'room', x, y: -y }, name);
  for (const [name, x, y] of home.objects) put(put(svg, 'circle', { class: 'object', cx: x, cy: -y, r: 8 }), 'title', {}, name);
}

// The last entry that begins at or before a time; entries begin with their time.
function lastAt(entries, time) {
  let low = 0, high = entries.length;
  while (low < high) {
    const half = (low + high) >> 1;
    if (entries[half][0] <= time) low = half + 1; else high = half;
  }
  return low - 1;
}

function player(box, home) {
  const story = JSON.parse(box.querySelector('.story').textContent);
  const [svg, now] = [box.querySelector('svg'), box.querySelector('.now')];
  const [button, slider, speed] = ['button', 'input', 'select'].map(name => box.querySelector(name));
  drawHome(svg, home);
  const believed = put(svg, 'g', {});
  const way = put(svg, 'polyline', { class: 'way' });
  const cone = put(svg, 'polygon', { class: 'cone', points: '0,0 250,-136 250,136' });
  const robot = put(svg, 'polygon', { class: 'robot', points: '24,0 -18,-18 -18,18' });

  function show(time) {
    const at = Math.max(0, lastAt(story.path, time));
    const [t, x, y, heading] = story.path[at];
    const [t2, x2, y2] = story.path[Math.min(at + 1, story.path.length - 1)];
    const share = t2 > t ? Math.min(1, (time - t) / (t2 - t)) : 0;
    const place = `translate(${x + (x2 - x) * share} ${-(y + (y2 - y) * share)}) rotate(${-heading})`;
    robot.setAttribute('transform', place);
    cone.setAttribute('transform', place);
    cone.style.display = story.looks.some(look => look <= time && time < look + 8) ? '' : 'none';
    way.setAttribute('points', points(story.path.slice(0, at + 1).flatMap(([, x, y]) => [x, y])));
    const pieces = new Map();
    for (const [, change] of story.believed.slice(0, lastAt(story.believed, time) + 1)) {
      for (const [name, corners] of Object.entries(change)) corners.length ? pieces.set(name, corners) : pieces.delete(name);
    }
    believed.replaceChildren();
    for (const [name, corners] of pieces) {
      put(believed, 'polygon', { class: 'believed', points: points(corners) });
      const [x, y] = middle(corners);
      put(believed, 'text', { class: 'name', x, y }, name);
    }
    const said = lastAt(story.said, time);
    const text = `${(time / 10).toFixed(0)} s: ${said < 0 ? 'begins' : story.said[said][1]}`;
    if (now.textContent !== text) now.textContent = text;
    slider.setAttribute('aria-valuetext', text);
  }

  let before = null;
  function step(stamp) {
    if (before === null) return;
    const end = Number(slider.max);
    const time = Math.min(end, Number(slider.value) + (stamp - before) / 100 * Number(speed.value));
    // The slider holds whole steps: what is left over waits for the next frame.
    if (Math.floor(time) > Number(slider.value)) {
      slider.value = Math.floor(time);
      before = stamp;
      show(Number(slider.value));
    }
    if (Number(slider.value) >= end) return stop();
    requestAnimationFrame(step);
  }
  function stop() {
    before = null;
    button.textContent = 'Play';
    // While it plays a screen reader would be told every second.
    now.setAttribute('aria-live', 'polite');
  }
  button.addEventListener('click', () => {
    if (before !== null) return stop();
    if (Number(slider.value) >= Number(slider.max)) slider.value = 0;
    button.textContent = 'Stop';
    now.setAttribute('aria-live', 'off');
    requestAnimationFrame(stamp => { before = stamp; step(stamp); });
    before = performance.now();
  });
  slider.addEventListener('input', () => { stop(); show(Number(slider.value)); });
  show(0);
}

const homeData = document.querySelector('script.home');
if (homeData) {
  const home = JSON.parse(homeData.textContent);
  for (const trial of trials) {
    trial.addEventListener('toggle', () => {
      const box = trial.querySelector('.player');
      if (trial.open && box && !box.dataset.ready) {
        box.dataset.ready = 'yes';
        player(box, home);
      }
    });
  }
}
