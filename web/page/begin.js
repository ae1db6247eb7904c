// Says why the page cannot begin where its modules are not loaded, or are not understood.
const begun = () => document.body?.dataset.ready !== undefined;

/** @param {string} why */
const sayWhy = (why) => {
  const progress = document.getElementById("progress");
  if (progress) progress.textContent = why;
  else addEventListener("DOMContentLoaded", () => sayWhy(why));
};

if (location.protocol === "file:") sayWhy("This page needs a server: scripts/web.sh --serve");
addEventListener("error", ({ target, message }) => {
  if (begun() || !(message || target instanceof HTMLScriptElement)) return;
  sayWhy(`The page cannot begin: ${message || "its modules were not loaded. The console says why"}`);
}, true);
