// What goes wrong in the page's own code is said in the page, for readers and for the test that opens it.
addEventListener("error", (event) => {
  const root = document.documentElement;
  root.dataset.errors = String(Number(root.dataset.errors) + 1);
  const place = document.getElementById("errors");
  if (!place) return;
  place.hidden = false;
  place.textContent = `This page failed: ${event.message} (line ${event.lineno}). The figures are in report.csv.`;
});
