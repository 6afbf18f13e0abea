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
  let seen = null, asking = null, more = false, leaving = false;

  // Whatever is being filled in stays as it is: a form in which somebody is, or has typed.
  const changed = (field) => field.tagName === "SELECT"
    ? field.selectedIndex !== Math.max(0, [...field.options].findIndex((one) => one.defaultSelected))
    : field.type !== "hidden" && (field.checked !== field.defaultChecked || field.value !== field.defaultValue);
  const fields = (form) => [...form.querySelectorAll("input, select, textarea")];
  const held = (one) => one.tagName === "FORM" && fields(one).some((field) => field === document.activeElement || changed(field));
  const holds = (one) => one.nodeType === 1 && [one, ...one.querySelectorAll("form")].some(held);

  // What a part of the page is known by: a form by where it goes and what it sends unasked.
  const sent = (form) => fields(form).filter((one) => one.type === "hidden" && !["csrf", "once", "begun"].includes(one.name));
  const name = (one) => one.nodeType !== 1 ? one.nodeName : one.tagName !== "FORM"
    ? `${one.tagName} ${one.dataset.key || (one.tagName === "DETAILS" && one.firstElementChild.textContent) || ""}`
    : [one.getAttribute("action"), ...sent(one).map((field) => `${field.name}=${field.value}`)].join(" ");
  const plain = (one) => one.outerHTML.replace(/name="once" value="[^"]*"/, "");

  // Make a part of the page like the one that has just come, part by part.
  const renewPart = (old, fresh) => {
    if (old.nodeType !== 1) { if (old.data !== fresh.data) old.data = fresh.data; return; }
    if (held(old)) return;
    if (old.tagName === "FORM") { if (plain(old) !== plain(fresh)) old.replaceWith(fresh); return; }
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
  const stays = (main) => [...main.children].filter((one) => "stays" in one.dataset);
  const show = (fresh) => {
    const main = document.getElementById("main"), typed = [...main.querySelectorAll("form")].filter(held);
    if (!stays(fresh).length) fresh.prepend(...stays(main).map((one) => one.cloneNode(true)));
    renewPart(main, fresh);
    // A match may have gone elsewhere on the page: what was typed goes with it.
    for (const form of typed.filter((one) => !one.isConnected)) {
      const there = [...main.querySelectorAll("form")].find((one) => name(one) === name(form));
      if (there) fields(there).forEach((field, k) => { if (field.type !== "hidden") field.value = fields(form)[k].value; });
    }
  };
  const renew = async () => {
    more = asking !== null;
    if (asking || leaving) return;
    asking = new AbortController();
    try {
      const answer = await fetch(location.href, { cache: "no-store", signal: asking.signal });
      const fresh = answer.ok && new DOMParser().parseFromString(await answer.text(), "text/html").getElementById("main");
      if (fresh && !leaving) show(fresh);
    } catch { /* the next event tries again */ }
    asking = null;
    if (more) renew(); else again();
  };
  // A form is sent: what it is answered with is not to be taken away by a page that is asked for now.
  addEventListener("submit", () => {
    leaving = true;
    asking?.abort();
    setTimeout(() => { leaving = false; }, 10000);
  });
  addEventListener("pageshow", () => { leaving = false; });
  // Odds and finish may still be worked out when a page is shown.
  const again = () => { if (document.querySelector("[data-older]")) setTimeout(renew, 2000); };
  const follow = () => {
    const stream = new EventSource("/events");
    stream.onmessage = (event) => {
      if (seen !== null && seen !== event.data) renew();
      seen = event.data;
    };
  };
  addEventListener("DOMContentLoaded", () => { follow(); again(); });
  setInterval(renew, 60000);
})();
