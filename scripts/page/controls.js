"use strict";
// The controls of the 3D view: which level, which instant, playing, and turning the camera.

const controls = (() => {
  function make(name, properties = {}, ...children) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(properties))
      if (key in element && key !== "list") element[key] = value;
      else element.setAttribute(key, value);
    element.append(...children);
    return element;
  }

  // A row of buttons of which one is pressed.
  function choice(label, entries, chosen, choose) {
    const group = make("div", {className: "choice", role: "group", "aria-label": label});
    const press = (value) => {
      for (const button of group.children)
        button.setAttribute("aria-pressed", String(button.value === String(value)));
    };
    for (const [value, text] of entries)
      group.append(make("button", {type: "button", value: String(value), textContent: text,
                                   onclick() { press(value); choose(value); }}));
    press(chosen);
    return {group, press};
  }

  class Controls {
    // `figure` is the element to fill, `facts` a line about each body by its label.
    constructor(figure, data, facts) {
      this.canvas = make("canvas", {tabIndex: 0, className: "scene", role: "img"});
      this.view = new viewer.Viewer(this.canvas, data);
      this.bodies = this.view.bodies;
      this.facts = facts;
      this.end = data.times[data.times.length - 1];
      this.playing = false;
      this.speed = 1;
      this.chains = data.chains || [];
      figure.append(this.canvas, this.bar());
      this.listen();
      this.select(this.bodies[0].label);
      new ResizeObserver(() => this.redraw()).observe(this.canvas);
      matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
    }

    bar() {
      const bar = make("div", {className: "controls"});
      this.status = make("output", {className: "status", "aria-live": "polite"});
      if (this.chains.length > 1) {
        this.chainChoice = choice("how the levels are made",
          this.chains.map((name, i) => [i + 1, name]), 1, (chain) => this.selectChain(chain));
        bar.append(this.chainChoice.group);
      }
      this.slider = make("input", {type: "range", min: "0", step: "1", id: "level",
                                   oninput: () => this.selectIndex(Number(this.slider.value))});
      const level = make("div", {className: "row"},
        make("label", {htmlFor: "level", textContent: "level"}), this.slider, this.status);
      bar.append(level);
      if (this.end > 0) bar.append(this.timeRow());
      bar.append(this.optionRow());
      return bar;
    }

    timeRow() {
      this.button = make("button", {type: "button", className: "play",
                                    onclick: () => this.toggle()});
      this.clock = make("output", {className: "clock"});
      this.instant = make("input", {
        type: "range", min: "0", max: String(this.end), step: "any", value: "0",
        "aria-label": "time", oninput: () => {
          this.pause();
          this.view.time = Number(this.instant.value);
          this.redraw();
        }});
      this.showPlaying();
      return make("div", {className: "row"}, this.button, this.instant, this.clock);
    }

    optionRow() {
      const row = make("div", {className: "row options"});
      const {view} = this;
      if (view.surface) {
        row.append(choice("what is drawn", [["surface", "surface"], ["springs", "springs"]],
          view.mode, (mode) => { view.mode = mode; this.redraw(); }).group);
      }
      if (this.end > 0) {
        row.append(choice("speed", [[1, "1×"], [0.25, "¼×"], [0.1, "⅒×"]], 1,
          (speed) => { this.speed = speed; }).group);
      }
      if (this.end > 0 && this.bodies[0].level === 0 && this.bodies.length > 1) {
        const box = make("input", {type: "checkbox", id: "ghost",
          onchange: () => { view.ghost = box.checked; this.redraw(); }});
        row.append(make("label", {className: "check"}, box, "base behind"));
      }
      return row;
    }

    ofChain(chain) { return this.bodies.filter((b) => b.level === 0 || b.chain === chain); }

    // Level of the same number in another chain.
    selectChain(chain) {
      const own = this.ofChain(chain), level = this.view.body.level;
      this.chain = chain;
      this.show(own.find((b) => b.level === level) || own[own.length - 1]);
    }

    selectIndex(index) { this.show(this.ofChain(this.chain)[index]); }

    has(label) { return this.bodies.some((b) => b.label === label); }

    select(label) {
      const body = this.bodies.find((b) => b.label === label);
      if (!body) return;
      if (body.level > 0 || !this.chain) this.chain = body.chain;
      this.show(body);
    }

    show(body) {
      this.view.body = body;
      const own = this.ofChain(this.chain);
      this.slider.max = String(own.length - 1);
      this.slider.disabled = own.length < 2;
      this.slider.value = String(own.indexOf(body));
      this.slider.setAttribute("aria-valuetext", body.label);
      if (this.chainChoice) this.chainChoice.press(this.chain);
      const fact = this.facts[body.label];
      this.status.replaceChildren(make("b", {textContent: body.label}),
        ` ${body.nodes} nodes, ${body.springs} springs${fact ? ", " + fact : ""}`);
      this.canvas.setAttribute("aria-label", `${body.label} in 3D. Arrow keys turn, plus and ` +
        "minus zoom, 0 resets, space plays.");
      this.redraw();
      if (this.onshow) this.onshow(body.label);
    }

    // ---- Time -----------------------------------------------------------------------------------

    play(from) {
      if (this.end <= 0) return;
      if (from !== undefined) this.view.time = from;
      else if (this.view.time >= this.end) this.view.time = 0;
      this.playing = true;
      this.last = undefined;
      this.showPlaying();
      this.redraw();
    }

    pause() {
      this.playing = false;
      this.showPlaying();
    }

    toggle() { if (this.playing) this.pause(); else this.play(); }

    showPlaying() {
      if (!this.button) return;
      this.button.textContent = this.playing ? "❚❚" : "▶";
      this.button.setAttribute("aria-label", this.playing ? "pause" : "play");
    }

    redraw() {
      if (this.waiting) return;
      this.waiting = true;
      requestAnimationFrame((now) => this.frame(now));
    }

    frame(now) {
      this.waiting = false;
      if (this.playing) {
        if (this.last !== undefined) this.view.time += this.speed * (now - this.last) / 1000;
        this.last = now;
        if (this.view.time >= this.end) {
          this.view.time = this.end;
          this.pause();
        }
      }
      this.view.draw();
      if (this.clock) {
        this.instant.value = String(this.view.time);
        this.instant.setAttribute("aria-valuetext", `${this.view.time.toFixed(2)} s`);
        this.clock.textContent = `${this.view.time.toFixed(2)} s`;
      }
      if (this.playing) this.redraw();
    }

    // ---- Camera ---------------------------------------------------------------------------------

    listen() {
      const {canvas} = this, {camera} = this.view;
      const held = new Map(); // pointers that are down
      canvas.addEventListener("pointerdown", (event) => {
        canvas.setPointerCapture(event.pointerId);
        held.set(event.pointerId, event);
      });
      const release = (event) => held.delete(event.pointerId);
      canvas.addEventListener("pointerup", release);
      canvas.addEventListener("pointercancel", release);
      canvas.addEventListener("pointermove", (event) => {
        const before = held.get(event.pointerId);
        if (!before) return;
        const spread = () => {
          const [a, b] = [...held.values()];
          return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY) || 1;
        };
        const old = held.size === 2 ? spread() : 0;
        held.set(event.pointerId, event);
        if (held.size === 2) camera.magnify(spread() / old);
        else camera.turn(-0.008 * (event.clientX - before.clientX),
                         0.008 * (event.clientY - before.clientY));
        this.redraw();
      });
      // The wheel belongs to the page until the view has the focus.
      canvas.addEventListener("wheel", (event) => {
        if (document.activeElement !== canvas) return;
        event.preventDefault();
        camera.magnify(Math.exp(-0.0015 * event.deltaY));
        this.redraw();
      }, {passive: false});
      const keys = {
        ArrowLeft: () => camera.turn(-0.1, 0), ArrowRight: () => camera.turn(0.1, 0),
        ArrowUp: () => camera.turn(0, 0.1), ArrowDown: () => camera.turn(0, -0.1),
        "+": () => camera.magnify(1.15), "=": () => camera.magnify(1.15),
        "-": () => camera.magnify(1 / 1.15), "0": () => camera.reset(), " ": () => this.toggle(),
      };
      canvas.addEventListener("keydown", (event) => {
        const act = keys[event.key];
        if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        act();
        this.redraw();
      });
    }
  }

  return {Controls, make};
})();
