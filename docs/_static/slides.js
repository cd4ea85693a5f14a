// A module's page as slides: MODULE.html?slides, or the button below the page. What the page shows is cut into slides and
// stays alive, for its nodes are moved; the first sentence of each paragraph and those with formulas stand on its slide, and
// the whole text is the speaker's. Right and left turn, N shows the notes, S opens a window for the speaker that follows, P
// prints slides with notes, Escape ends.
{
  const LARGE = "figure, iframe, table, .series, .mistakes, .before-after, .pattern-explorer, details, .table-wrapper";
  const SHORT = 40; // characters: a sentence such as "This is method 1." says nothing by itself
  const asked = new URLSearchParams(location.search);
  const page = document.querySelector("article section");
  const address = (number, more = "") => `${location.pathname}?slides=${number}${more}`;

  // Of a paragraph its first sentence, the next one where that is short, and those with formulas.
  const sentence = (paragraph) => {
    const part = document.createElement("p");
    part.className = "lead";
    let [one, gap] = [[], ""];
    const end = () => {
      const formula = one.some((node) => node.querySelector?.("mo"));
      if (part.textContent.length < SHORT || formula) (part.append(gap, ...one), (gap = ""));
      else gap = " …";
      one = [];
    };
    for (const node of paragraph.childNodes) {
      if (node.nodeType !== Node.TEXT_NODE) one.push(node.cloneNode(true));
      else for (const piece of node.data.split(/(?<=[.?!])(?=\s)/)) (one.push(piece), /[.?!]$/.test(piece) && end());
    }
    end();
    return part;
  };

  // What is folded on the page is shown, with what is right beside what is wrong.
  const unfold = () => {
    for (const alone of page.querySelectorAll(".mistakes.alone")) alone.remove();
    for (const folded of page.querySelectorAll("details.deep")) folded.replaceWith(...[...folded.children].slice(1));
  };

  const made = (title, whole) => ({ title, whole, shown: [], notes: [] });
  const large = (node) => node.matches(LARGE) || node.querySelector(LARGE);

  // A slide that would hold one paragraph alone gives it to the one before.
  const end = (slide, slides) => {
    const before = slides.at(-1);
    const alone = slide.notes.length === 1 && slide.shown.length === 1;
    if (before?.title === slide.title && alone) before.notes.push(...slide.notes);
    else if (slide.shown.length) slides.push(slide);
  };

  // Paragraphs go before what they lead to; something large ends its slide.
  const cut = (section, slides) => {
    const title = section.querySelector(":scope > h1, :scope > h2, :scope > h3");
    let slide = made(title, section === page);
    for (const node of [...section.children]) {
      if (node === title || ["SPAN", "SCRIPT"].includes(node.tagName)) continue;
      if (node.tagName === "SECTION") {
        end(slide, slides);
        slide = made(title, false);
        cut(node, slides);
      } else if (node.tagName === "P" && !node.querySelector("img, video") && !/:\s*$/.test(node.textContent)) {
        if (node.textContent === node.querySelector("a")?.textContent) continue;
        slide.notes.push(node);
        slide.shown.push(sentence(node));
      } else {
        slide.shown.push(node);
        if (large(node)) {
          slides.push(slide);
          slide = made(title, false);
        }
      }
    }
    end(slide, slides);
    return slides;
  };

  const drawn = (slide, number, count) => {
    const box = document.createElement("section");
    box.className = slide.whole ? "slide first" : "slide";
    box.setAttribute("aria-label", `Slide ${number} of ${count}`);
    const title = document.createElement("h2");
    title.textContent = slide.title.firstChild.textContent;
    const [seen, text, last] = ["seen", "text", "last"].map((name) => {
      const part = document.createElement("div");
      part.className = name;
      return part;
    });
    const ends = large(slide.shown.at(-1));
    text.append(...(ends ? slide.shown.slice(0, -1) : slide.shown));
    last.append(...(ends ? [slide.shown.at(-1)] : []));
    seen.append(title, text, last);
    const notes = document.createElement("aside");
    notes.setAttribute("aria-label", "Speaker's notes");
    notes.append(...slide.notes);
    if (!slide.notes.length) notes.append("Say what the slide shows.");
    const place = document.createElement("footer");
    place.textContent = `${number} / ${count}`;
    box.append(seen, notes, place);
    return box;
  };

  // How high a figure's pictures may be, in hundredths of the window's height.
  const PICTURES = [76, 69, 62, 56, 50, 45, 40, 35, 30];

  const wear = (seen, { size, layout, picture }) => {
    seen.className = `seen ${layout}`;
    seen.style.fontSize = `${size}%`;
    seen.style.setProperty("--picture", `${picture}vh`);
  };

  // Square pixels of all pictures in a figure.
  const area = (figure) =>
    [...figure.querySelectorAll("img, svg, canvas, iframe")].reduce((sum, part) => sum + part.clientWidth * part.clientHeight, 0);

  // The largest type with which a slide fits, or up to two steps less where the figure gains more by it. The figure is
  // below the text, or beside it, where a wide formula takes half of the slide. What doesn't fit at all scrolls.
  const fit = (box) => {
    const seen = box.querySelector(".seen");
    const last = seen.querySelector(".last");
    const fits = (part) => part.scrollWidth <= part.clientWidth + 2;
    const layouts = seen.querySelector(".text").children.length && last.children.length ? ["", "beside", "beside even"] : [""];
    let best = null;
    for (const size of [100, 90, 80, 70, 60, 50]) {
      if (best && size < Math.max(best.largest - 20, 70)) break;
      for (const layout of layouts) {
        for (const picture of PICTURES) {
          const way = { size, layout, picture };
          wear(seen, way);
          if (seen.scrollHeight > seen.clientHeight || ![seen, ...seen.querySelectorAll(".formula, pre")].every(fits)) continue;
          const worth = area(last) * size ** 2;
          if (!best || worth > best.worth) best = { ...way, worth, largest: best?.largest ?? size };
          break;
        }
      }
    }
    wear(seen, best ?? { size: 50, layout: layouts.at(-1), picture: 62 });
  };

  const show = () => {
    unfold();
    const slides = cut(page, []);
    const boxes = slides.map((slide, k) => drawn(slide, k + 1, slides.length));
    const deck = document.createElement("main");
    deck.className = "deck";
    deck.append(...boxes);
    document.body.replaceChildren(deck);
    document.documentElement.classList.add("slides");
    for (const picture of deck.querySelectorAll("img")) picture.loading = "eager";
    const speaker = asked.has("notes");
    deck.classList.toggle("notes", speaker);
    let other = speaker ? opener : null;
    let at = 0;
    const turn = (to, tell = true) => {
      at = Math.min(Math.max(to, 0), boxes.length - 1);
      boxes.forEach((box, k) => box.classList.toggle("now", k === at));
      fit(boxes[at]);
      history.replaceState(null, "", address(at + 1, speaker ? "&notes" : ""));
      dispatchEvent(new Event("resize"));
      if (tell) other?.postMessage({ slide: at }, "*");
    };
    addEventListener("message", (event) => {
      if (event.source === other && Number.isInteger(event.data?.slide)) turn(event.data.slide, false);
    });
    addEventListener("keydown", (event) => {
      // A slider has the arrows for itself.
      if (event.altKey || event.ctrlKey || event.metaKey || event.target.matches("input, select, textarea")) return;
      const steps = { ArrowRight: 1, PageDown: 1, " ": 1, ArrowLeft: -1, PageUp: -1, Home: -at, End: boxes.length };
      const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
      if (key in steps && !(key === " " && event.target.matches("button, summary, a"))) turn(at + steps[key]);
      else if (key === "n") (deck.classList.toggle("notes"), fit(boxes[at]));
      else if (key === "s" && !speaker) other = open(address(at + 1, "&notes"), "speaker", "popup,width=900,height=700");
      else if (key === "p") print();
      else if (key === "Escape") location.assign(location.pathname);
      else return;
      event.preventDefault();
    });
    deck.addEventListener("click", (event) => {
      const still = event.target.closest("a, button, input, select, label, summary, figure, iframe, svg, .formula, aside");
      if (!still) turn(at + (event.clientX < innerWidth / 3 ? -1 : 1));
    });
    addEventListener("load", () => fit(boxes[at]));
    turn((parseInt(asked.get("slides"), 10) || 1) - 1);
  };

  if (page && /\/modules\//.test(location.pathname)) {
    if (asked.has("slides")) {
      // After the other scripts have made their figures.
      addEventListener("DOMContentLoaded", () => setTimeout(show));
    } else {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = "Show as slides";
      button.addEventListener("click", () => location.assign(address(1)));
      document.querySelector(".edition")?.append(" ", button);
    }
  }
}
