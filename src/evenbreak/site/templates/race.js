"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const [NAME, POINT, GROUP, RATING, ERROR] = [0, 1, 2, 3, 4];
const doubling = Math.LN2 / data.scale;

function average(rule, chance) {
  let total = 0;
  for (const [node, weight] of rule) total += weight * chance(node);
  return total;
}

function game(logOdds) {
  return 1 / (1 + Math.exp(-logOdds));
}

// P(player 1 wins m games before player 2 wins n), each game with the chance p.
function win(p, m, n) {
  let term = Math.pow(p, m), total = 0;
  for (let lost = 0; lost < n; lost++) {
    total += term;
    term *= (1 - p) * (m + lost) / (lost + 1);
  }
  return Math.min(total, 1);
}

// Form of the day: the log-odds about which a game is won as often as without form.
function center(mean, error, around) {
  if (!data.form) return mean;
  const wanted = average(data.game, (z) => game(mean + error * z));
  let low = -6 * Math.abs(mean) - 1, high = -low;
  for (let step = 0; step < 100; step++) {
    const middle = (low + high) / 2;
    if (average(data.game, (z) => game(middle + around * z)) < wanted) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}

function levels(a, b) {
  return [data.rule.levels.indexOf(a[POINT]), data.rule.levels.indexOf(b[POINT])];
}

function gap(a, b) {
  let points = a[RATING] - b[RATING], error = Math.hypot(a[ERROR], b[ERROR]);
  if (data.rule.levels) {
    const [i, j] = levels(a, b);
    points = data.rule.gaps[i][j];
    error = data.rule.errors[i][j];
  }
  const off = error * doubling, around = Math.hypot(off, data.form);
  return {mean: center(points * doubling, off, around), around};
}

function chance(apart, m, n) {
  return average(data.race, (z) => win(game(apart.mean + apart.around * z), m, n));
}

function fairest(apart) {
  const tie = 1e-9;
  let best = null;
  const rule = data.rule;
  if (rule.race_to) {
    const ahead = apart.mean >= 0, strong = {mean: Math.abs(apart.mean), around: apart.around};
    for (let fewer = 1; fewer <= rule.race_to; fewer++) {
      const away = Math.abs(chance(strong, rule.race_to, fewer) - 0.5);
      if (!best || away < best.away - tie) best = {away, race: [rule.race_to, fewer]};
    }
    return ahead ? best.race : best.race.reverse();
  }
  for (let longest = rule.games[0]; longest <= rule.games[1]; longest++) {
    const row = [];
    for (let m = 1; m <= longest; m++) row.push(Math.abs(chance(apart, m, longest + 1 - m) - 0.5));
    const least = Math.min(...row), m = row.findIndex((away) => away <= least + tie);
    if (!best || row[m] < best.away - tie) best = {away: row[m], race: [m + 1, longest - m]};
  }
  return best.race;
}

function needs(a, b, apart) {
  const rule = data.rule;
  if (rule.rows) {
    const points = a[POINT] - b[POINT], size = Math.abs(points);
    const row = rule.rows.filter((one) => one[0] <= size).pop();
    return points >= 0 ? [row[1], row[2]] : [row[2], row[1]];
  }
  if (rule.levels) {
    const [i, j] = levels(a, b);
    return [rule.needs[i][j], rule.needs[j][i]];
  }
  return fairest(apart);
}

// The race of two players, by their places in the list; null where they cannot be compared.
function race(first, second) {
  const a = data.players[first], b = data.players[second];
  if (a[GROUP] && b[GROUP] && a[GROUP] !== b[GROUP]) return null;
  const unsaid = data.rule.levels && !data.rule.gaps;  // a chart of points alone
  const apart = unsaid ? null : gap(a, b), [m, n] = needs(a, b, apart);
  return {m, n, p: unsaid ? null : chance(apart, m, n)};
}

const buttons = data.players.map((player, k) => {
  const button = document.createElement("button"), who = document.createElement("bdi");
  who.textContent = player[NAME];
  button.type = "button";
  button.dataset.player = k;
  button.append(who);
  return button;
});
document.querySelector(".names").append(...buttons);
const shown = document.getElementById("race"), said = document.getElementById("said");
let picked = [];

function dots(many) {
  const row = document.createElement("span");
  row.className = "dots";
  row.setAttribute("aria-hidden", "true");
  for (let k = 0; k < many; k++) row.append(document.createElement("i"));
  return row;
}

function side(name, many) {
  const box = document.createElement("div"), who = document.createElement("bdi");
  who.textContent = name;
  box.append(who, dots(many));
  return box;
}

function show() {
  for (const one of buttons) {
    one.setAttribute("aria-pressed", picked.includes(Number(one.dataset.player)));
  }
  const names = picked.map((k) => data.players[k][NAME]);
  shown.replaceChildren();
  if (picked.length < 2) {
    said.textContent = picked.length ? said.dataset.second.replace("{player}", () => names[0]) : said.dataset.first;
    return;
  }
  const found = race(...picked);
  if (!found) {
    said.textContent = said.dataset.none;
    return;
  }
  const score = document.createElement("strong");
  score.textContent = `${found.m}–${found.n}`;
  shown.append(side(names[0], found.m), score, side(names[1], found.n));
  const percent = Math.round(100 * found.p);
  const values = {a: names[0], b: names[1], m: found.m, n: found.n, percent};
  const words = found.p === null ? said.dataset.needs : said.dataset.race;
  said.textContent = words.replace(/\{(\w+)\}/g, (_, key) => values[key]);
}

for (const one of buttons) {
  one.addEventListener("click", () => {
    const k = Number(one.dataset.player);
    if (picked.includes(k)) picked = picked.filter((other) => other !== k);
    else picked = picked.length === 2 ? [picked[0], k] : [...picked, k];
    show();
  });
}
const filter = document.getElementById("filter");
filter.addEventListener("input", () => {
  const wanted = filter.value.trim().toLowerCase();
  for (const one of buttons) one.hidden = !one.textContent.toLowerCase().includes(wanted);
});
document.getElementById("pick").hidden = false;
show();
