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
  let seen = null, waiting = false;
  // A form that somebody has begun to fill in is left alone.
  const begun = () =>
    [...document.querySelectorAll("#main input")].some((one) =>
      one.checked !== one.defaultChecked || (one.type !== "radio" && one.value !== one.defaultValue)) ||
    [...document.querySelectorAll("#main select")].some((one) =>
      one.selectedIndex !== Math.max(0, [...one.options].findIndex((each) => each.defaultSelected)));
  const busy = () => {
    const at = document.activeElement;
    return at && /^(INPUT|SELECT|TEXTAREA)$/.test(at.tagName) || begun();
  };
  const plain = (one) => one.innerHTML.replace(/name="once" value="[^"]*"/g, "");
  const title = (one) => one.firstElementChild.textContent;
  const renew = async () => {
    if (waiting) return;
    if (busy()) { again(); return; }
    waiting = true;
    try {
      const answer = await fetch(location.href, { cache: "no-store" });
      if (answer.ok) {
        const found = new DOMParser().parseFromString(await answer.text(), "text/html");
        const fresh = found.getElementById("main"), old = document.getElementById("main");
        if (fresh && old && plain(fresh) !== plain(old)) {
          const left = [...old.querySelectorAll(".bracket")].map((one) => one.scrollLeft);
          const open = [...old.querySelectorAll("details")].filter((one) => one.open).map(title);
          fresh.querySelectorAll("details").forEach((one) => { one.open ||= open.includes(title(one)); });
          old.replaceWith(fresh);
          fresh.querySelectorAll(".bracket").forEach((one, k) => { one.scrollLeft = left[k] || 0; });
        }
      }
    } catch { /* the next event tries again */ }
    waiting = false;
    again();
  };
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
