
const box = document.querySelector(".search");
const rows = [...document.querySelectorAll(
  ".races tbody tr, .ratings tbody tr, .matches tbody tr, .match tbody, .narrow details"
)];
const plain = text => text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();
const names = rows.map(row => plain(
  [...(row.querySelector("summary") || row).querySelectorAll("bdi")].map(name => name.textContent).join(" ")
));
box.hidden = false;
box.querySelector("input").addEventListener("input", event => {
  const wanted = plain(event.target.value.trim());
  rows.forEach((row, k) => row.classList.toggle("miss", !names[k].includes(wanted)));
});
