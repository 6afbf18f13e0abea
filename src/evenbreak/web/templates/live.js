"use strict";
(() => {
  const live = "live" in document.currentScript.dataset;
  // A field for other kinds of tournaments is neither shown nor sent.
  const fit = () => document.querySelectorAll("[data-for]").forEach((one) => {
    const kind = document.querySelector(`[name=${one.dataset.by}]`).value;
    one.hidden = !one.dataset.for.split(" ").includes(kind);
    one.querySelectorAll("input, select").forEach((field) => { field.disabled = one.hidden; });
  });
  addEventListener("DOMContentLoaded", () => { fit(); addEventListener("change", fit); });
  if (!live) return;
  let seen = null, asking = null, more = false, leaving = false, stream = null;
  const main = () => document.getElementById("main");

  // What a tap opens is in view, above the bar at the bottom.
  const into = (part) => requestAnimationFrame(() => part?.scrollIntoView({ block: "nearest" }));
  addEventListener("change", ({ target }) => { if (target.matches?.(".taps [type=radio]")) into(target.form.querySelector(`.after${/pick(\d)/.exec(target.className)[1]}`)); });
  addEventListener("click", ({ target }) => { const all = target.closest?.("summary")?.parentElement; if (all && !all.open) into([...all.querySelectorAll(".btn")].pop()); });

  // Whatever is being filled in stays as it is: a form in which somebody is, or has typed.
  const changed = (field) => field.tagName === "SELECT"
    ? field.selectedIndex !== Math.max(0, [...field.options].findIndex((one) => one.defaultSelected))
    : field.type !== "hidden" && (field.checked !== field.defaultChecked || field.value !== field.defaultValue);
  const fields = (form) => [...form.querySelectorAll("input, select, textarea")];
  const held = (one) => one.tagName === "FORM" && fields(one).some((field) => field === document.activeElement || changed(field));
  const holds = (one) => one.nodeType === 1 && [one, ...one.querySelectorAll("form")].some(held);

  // What a part of the page is known by: a form by where it goes and what it sends unasked.
  const sent = (form) => fields(form).filter((one) => one.type === "hidden" && !["csrf", "once", "begun", "seen", "a", "b"].includes(one.name));
  const name = (one) => one.nodeType !== 1 ? one.nodeName : one.tagName !== "FORM"
    ? `${one.tagName} ${one.dataset.key || (one.tagName === "DETAILS" && one.firstElementChild.textContent) || ""}`
    : [one.getAttribute("action"), ...sent(one).map((field) => `${field.name}=${field.value}`)].join(" ");
  const plain = (one) => one.outerHTML.replace(/name="once" value="[^"]*"/, "");

  // Make a part of the page like the one that has just come, part by part.
  const renewPart = (old, fresh) => {
    if (old.nodeType !== 1) { if (old.data !== fresh.data) old.data = fresh.data; return; }
    if (held(old)) return;
    if (old.tagName === "FORM") {
      if (plain(old) === plain(fresh)) return;
      // A button stays the same one, so that a tap on it is not lost; fields are made anew.
      if (fields(old).some((field) => field.type !== "hidden")) { old.replaceWith(fresh); return; }
    }
    for (const { name: key } of [...old.attributes]) if (!fresh.hasAttribute(key) && key !== "open") old.removeAttribute(key);
    for (const { name: key, value } of fresh.attributes) if (old.getAttribute(key) !== value) old.setAttribute(key, value);
    let at = old.firstChild;
    for (const one of [...fresh.childNodes]) {
      let same = at;
      while (same && name(same) !== name(one)) same = same.nextSibling;
      if (!same) { old.insertBefore(one, at); continue; }
      // What is filled in is not moved, for a field would lose the focus; what is before it is.
      while (at !== same && holds(same)) { const next = at.nextSibling; at.remove(); at = next; }
      if (at === same) at = same.nextSibling; else old.insertBefore(same, at);
      renewPart(same, one);
    }
    while (at) { const next = at.nextSibling; at.remove(); at = next; }
  };
  // An answer stays until it is read, or another one takes its place.
  const stays = (part) => [...part.children].filter((one) => "stays" in one.dataset);
  addEventListener("click", (event) => { event.target.closest?.("[data-read]")?.closest("[data-stays]")?.remove(); });
  const show = (text) => {
    const page = new DOMParser().parseFromString(text, "text/html"), fresh = page.getElementById("main");
    if (!fresh) return;
    const typed = [...main().querySelectorAll("form")].filter(held);
    if (!stays(fresh).length) fresh.prepend(...stays(main()).map((one) => one.cloneNode(true)));
    renewPart(main(), fresh);
    // A match may have gone elsewhere on the page: what was typed goes with it.
    for (const form of typed.filter((one) => !one.isConnected)) {
      const there = [...main().querySelectorAll("form")].find((one) => name(one) === name(form));
      if (there) fields(there).forEach((field, k) => { if (field.type !== "hidden") field.value = fields(form)[k].value; });
    }
    document.title = page.title;
    document.documentElement.className = page.documentElement.className;
    dress();
  };

  // The connection: a page that has lost it says so, and since when.
  let last = Date.now(), retry = 0;
  const bar = () => document.getElementById("lost");
  const heard = () => { last = Date.now(); if (bar()) bar().hidden = true; };
  const silent = () => {
    if (Date.now() - last > 4000 && bar()) {
      const at = new Date(last).toLocaleTimeString([], { hour: "2-digit", minute: "2-digit", hourCycle: "h23" });
      const words = bar().dataset.lost.replace("{at}", at) + (main().querySelector("form[data-kept]") || kept().length ? ` ${bar().dataset.taps}` : "");
      if (bar().textContent !== words) bar().textContent = words;
      bar().hidden = false;
    }
    clearTimeout(retry);
    retry = setTimeout(renew, 2000);
  };
  const ask = async (to, options) => {
    const mine = asking = new AbortController(), stop = setTimeout(() => mine.abort(), 8000);
    try {
      const answer = await fetch(to, { cache: "no-store", signal: mine.signal, ...options });
      const text = await answer.text();
      heard();
      return { answer, text };
    } finally { clearTimeout(stop); if (asking === mine) asking = null; }
  };
  const renew = async () => {
    more = asking !== null;
    if (asking || leaving) return;
    if (kept().length) { send(); return; }
    try {
      const { answer, text } = await ask(location.href);
      if (answer.ok && !leaving && !kept().length) show(text);
    } catch { if (!leaving) { silent(); return; } }
    if (more) renew(); else again();
  };

  // A tap of the score is shown at once, and kept until the page's computer has it: once, by its number.
  const KEPT = "evenbreak taps";
  let taps = [], tapped = {};
  const kept = () => { try { return JSON.parse(localStorage.getItem(KEPT)) || []; } catch { return taps; } };
  const keep = (now) => { taps = now; try { localStorage.setItem(KEPT, JSON.stringify(now)); } catch { /* in this page alone */ } };
  const score = (text) => text.split(":").map(Number);
  const ahead = (form) => {
    const its = form.elements;
    if (!its.seen) return;
    const now = [its.a, its.b].map((field) => Number(field.value));
    for (const one of main().querySelectorAll("form[data-kept]")) {
      const { seen: shown, a, b, once } = one.elements;
      if (!shown) continue;
      const steps = score(shown.value).map((was, k) => Number([a, b][k].value) - was);
      if (Math.abs(steps[0]) + Math.abs(steps[1]) !== 1) continue;
      [a, b].forEach((field, k) => { field.value = Math.max(0, now[k] + steps[k]); });
      shown.value = now.join(":");
      once.value = [...crypto.getRandomValues(new Uint8Array(9))].map((byte) => byte.toString(36)).join("");
    }
    for (const one of main().querySelectorAll("[data-won]")) {
      const won = now[one.dataset.won];
      one.textContent = won;
      one.closest("button").querySelectorAll(".dots i").forEach((dot, k) => dot.classList.toggle("on", k < won));
      if (won >= Number(one.dataset.needs)) main().querySelectorAll(".halves button").forEach((button) => { button.disabled = true; });
    }
  };
  let sending = false;
  const send = async () => {
    if (sending || !kept().length) return;
    sending = true;
    asking?.abort();
    try {
      while (kept().length) {
        const [first] = kept();
        const { answer, text } = await ask(first.to, { method: "POST", body: new URLSearchParams(first.body) });
        // What was tapped after a tap that is refused counted from it.
        keep(kept().filter((one) => one.body !== first.body && (answer.ok || one.to !== first.to)));
        if (kept().length) continue;
        if (first.to.split("/")[1] !== location.pathname.split("/")[1]) { more = true; continue; }
        history.replaceState(null, "", answer.url);
        show(text);
      }
    } catch { silent(); }
    sending = false;
    if (more && !kept().length) renew();
  };
  // A form is sent: what it is answered with is not to be taken away by a page that is asked for now.
  addEventListener("submit", (event) => {
    const form = event.target;
    if ("kept" in form.dataset) {
      event.preventDefault();
      const where = form.getAttribute("action");
      if (where === tapped.where && Date.now() - tapped.at < 600) return; // a double tap
      tapped = { where, at: Date.now() };
      keep([...kept(), { to: where, body: new URLSearchParams(new FormData(form)).toString() }]);
      ahead(form);
      send();
      return;
    }
    leaving = true;
    asking?.abort();
    setTimeout(() => { leaving = false; }, 10000);
  });

  // "Ring when I'm up": browsers allow a sound after one tap.
  let sound = null;
  const wants = (yes) => { try { if (yes) localStorage.setItem("evenbreak ring", "yes"); return localStorage.getItem("evenbreak ring"); } catch { return sound; } };
  const allow = () => { if (!sound && window.AudioContext) sound = new AudioContext(); sound?.resume(); };
  const ring = (times) => {
    navigator.vibrate?.(Array(times).fill([350, 150]).flat());
    for (let k = 0; sound && k < times; k += 1) {
      const tone = sound.createOscillator(), loud = sound.createGain(), at = sound.currentTime + k * 0.5;
      tone.frequency.value = k % 2 ? 660 : 880;
      loud.gain.setValueAtTime(0.6, at);
      loud.gain.exponentialRampToValueAtTime(0.001, at + 0.45);
      tone.connect(loud).connect(sound.destination);
      tone.start(at);
      tone.stop(at + 0.45);
    }
  };
  let up = "";
  const dress = () => {
    const button = document.querySelector("[data-ring]");
    if (button) {
      button.hidden = !(window.AudioContext || navigator.vibrate);
      button.setAttribute("aria-pressed", String(!!wants()));
      if (wants()) button.querySelector("span").textContent = button.dataset.on;
    }
    const now = document.querySelector("[data-up]")?.dataset.up || "";
    if (now && now !== up && wants()) ring(6);
    up = now;
  };
  addEventListener("click", (event) => {
    if (event.target.closest?.("[data-ring]")) { wants(true); allow(); ring(1); dress(); } else if (wants()) allow();
  });

  // Odds and finish may still be worked out when a page is shown.
  let next = 0; // the wall shows another picture after a while
  const again = () => {
    const seconds = document.querySelector("[data-older]") ? 2 : document.querySelector("[data-again]")?.dataset.again;
    clearTimeout(next);
    if (seconds) next = setTimeout(renew, 1000 * seconds);
  };
  const follow = () => {
    stream?.close();
    stream = new EventSource("/events");
    stream.onmessage = (event) => {
      heard();
      if (seen !== null && seen !== event.data) renew();
      seen = event.data;
    };
    stream.onerror = () => { renew(); if (stream.readyState === 2) setTimeout(follow, 5000); };
  };
  // Whoever comes back to a page sees what is so now, however long the phone slept.
  const back = () => {
    leaving = false;
    if (document.hidden) return;
    if (!stream || stream.readyState === 2 || Date.now() - last > 25000) follow();
    renew();
  };
  addEventListener("DOMContentLoaded", () => { follow(); dress(); again(); send(); });
  document.addEventListener("visibilitychange", back);
  addEventListener("pageshow", (event) => { if (event.persisted) back(); leaving = false; });
  addEventListener("online", back);
  setInterval(() => { if (Date.now() - last > 30000) renew(); }, 5000);
  setInterval(renew, 60000);
})();
