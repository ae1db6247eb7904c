// Says why the page cannot begin where its modules are not loaded at all.
addEventListener("DOMContentLoaded", () => {
  const say = (/** @type {string} */ why) => {
    const progress = document.getElementById("progress");
    if (progress) progress.textContent = why;
  };
  if (location.protocol === "file:") say("This page needs a server: scripts/web.sh --serve");
  document.querySelector("script[type=module]")?.addEventListener("error", () => {
    say("The page cannot begin: its modules were not loaded. The console says why.");
  });
});
