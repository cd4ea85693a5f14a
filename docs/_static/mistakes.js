// Pictures of mistakes, enlarged: right, wrong and their difference beside each other. A picture is a button; the arrow keys
// go to the next mistake of the group, Escape closes.
{
  const figures = (group) => [...group.querySelectorAll("figure.wrong")];
  const dialog = document.createElement("dialog");
  dialog.className = "mistake";
  dialog.setAttribute("aria-label", "A mistake, enlarged");
  let group = null, at = 0;

  const pane = (name, ...pictures) => {
    const box = document.createElement("figure"), place = document.createElement("div"), said = document.createElement("figcaption");
    place.className = pictures.length > 1 ? "difference" : "";
    place.append(...pictures.map((picture) => Object.assign(picture.cloneNode(), { loading: "eager" })));
    if (pictures.length > 1) [...place.children].forEach((each) => (each.alt = ""));
    said.textContent = name;
    box.append(place, said);
    return box;
  };
  const show = () => {
    const wrong = figures(group)[at], right = group.querySelector("figure.right");
    const pictures = [right, wrong].map((each) => each.querySelector("img"));
    const panes = document.createElement("div"), close = document.createElement("button"), words = document.createElement("div");
    panes.className = wrong.classList.contains("plot") ? "panes plot" : "panes";
    panes.append(pane("Right", pictures[0]), pane("With the mistake", pictures[1]), pane("Difference, four times as bright", ...pictures));
    words.append(...[...wrong.querySelector("figcaption").childNodes].map((each) => each.cloneNode(true)));
    Object.assign(close, { type: "button", textContent: "Close" });
    close.addEventListener("click", () => dialog.close());
    dialog.replaceChildren(panes, words, close);
    if (!dialog.open) dialog.showModal();
    close.focus();
  };
  dialog.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    at = (at + step + figures(group).length) % figures(group).length;
    show();
    event.preventDefault();
  });
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  dialog.addEventListener("close", () => figures(group)[at].querySelector("button").focus());

  for (const each of document.querySelectorAll(".mistakes")) {
    figures(each).forEach((figure, number) => {
      const button = document.createElement("button"), picture = figure.querySelector("img");
      button.type = "button";
      picture.replaceWith(button);
      button.append(picture);
      button.addEventListener("click", () => {
        [group, at] = [each, number];
        show();
      });
    });
  }
  if (document.querySelector(".mistakes")) document.body.append(dialog);
}
