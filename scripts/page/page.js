"use strict";
// Puts the page together: the 3D view, the charts, the film, and what they do to each other.

(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const film = document.getElementById("film");
  const frame = document.getElementById("film-panel");
  const scene = document.getElementById("scene");
  let view = null;

  if (scene) {
    try {
      view = new controls.Controls(scene, data.view, data.facts);
    } catch (error) {
      scene.replaceChildren(controls.make("p", {
        className: "missing", textContent: `${error.message} The levels cannot be shown in 3D.`}));
    }
  }

  const panels = data.panels || [];

  // Play button and time below the film: the browser's own would cover it.
  function filmRow() {
    film.controls = false;
    const clock = controls.make("output", {className: "clock"});
    const instant = controls.make("input", {type: "range", min: "0", step: "any", value: "0",
      "aria-label": "time of the film",
      oninput() { film.pause(); film.currentTime = Number(instant.value); }});
    const toggle = () => { if (film.paused) film.play(); else film.pause(); };
    const button = controls.make("button", {type: "button", className: "play", onclick: toggle});
    const whole = controls.make("button", {type: "button", textContent: "full screen",
      onclick() { film.requestFullscreen(); }});
    function show() {
      instant.max = String(film.duration || 1);
      instant.value = String(film.currentTime);
      clock.textContent = `${film.currentTime.toFixed(2)} s`;
      button.textContent = film.paused ? "▶" : "❚❚";
      button.setAttribute("aria-label", film.paused ? "play the film" : "pause the film");
    }
    // "timeupdate" comes only four times a second.
    const follow = () => {
      show();
      if (!film.paused) requestAnimationFrame(follow);
    };
    film.addEventListener("play", follow);
    for (const event of ["loadedmetadata", "pause", "seeked"]) film.addEventListener(event, show);
    film.addEventListener("click", toggle);
    show();
    film.parentElement.after(controls.make("div", {className: "row controls-row"},
                                           button, instant, clock, whole));
  }
  if (film) filmRow();

  // Frames the panel of a level in the film, if it has one.
  function mark(label) {
    if (!film) return;
    const panel = panels.indexOf(label);
    frame.hidden = panel < 0;
    frame.style.left = `${100 * panel / panels.length}%`;
    frame.style.width = `${100 / panels.length}%`;
  }

  const pick = {
    has: (label) => (view && view.has(label)) || panels.includes(label),
    play(label) {
      if (view && view.has(label)) {
        view.select(label);
        view.play(0);
        scene.scrollIntoView({block: "nearest"});
      } else if (film) {
        film.scrollIntoView({block: "nearest"});
      }
      if (film && panels.includes(label)) {
        film.currentTime = 0;
        film.play().catch(() => {}); // a browser may refuse to play unasked
      }
      choose(label);
    },
  };

  // Marks a level wherever it occurs.
  function choose(label) {
    mark(label);
    for (const element of document.querySelectorAll("[data-clip]"))
      element.classList.toggle("chosen", element.dataset.clip === label);
  }
  if (view) view.onshow = choose;

  // Names of levels in tables become buttons.
  for (const cell of document.querySelectorAll("td[data-label]")) {
    const {label} = cell.dataset;
    if (!pick.has(label)) continue;
    const button = controls.make("button", {type: "button", className: "level",
      textContent: cell.textContent, title: "play this level", onclick: () => pick.play(label)});
    button.dataset.clip = label;
    cell.replaceChildren(button);
  }

  (data.charts || []).forEach((chart, i) =>
    chartView.draw(document.getElementById(`chart-${i + 1}`), chart, pick));

  const copy = document.getElementById("copy");
  if (copy) copy.addEventListener("click", async () => {
    const text = document.getElementById("command").textContent;
    let done = true;
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      const range = document.createRange(); // files may not use the clipboard: select to copy
      range.selectNodeContents(document.getElementById("command"));
      getSelection().removeAllRanges();
      getSelection().addRange(range);
      done = document.execCommand("copy");
    }
    copy.textContent = done ? "copied" : "press Ctrl+C";
    setTimeout(() => { copy.textContent = "copy"; }, 2000);
  });

  window.springlodPage = {view, pick};
})();
