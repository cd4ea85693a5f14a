// A button that prints the page when all its pictures are there, also those that are loaded only when they are scrolled
// to.
{
  const load = () => {
    for (const folded of document.querySelectorAll("article details.deep")) folded.open = true;
    const pictures = [...document.querySelectorAll("article img")];
    for (const picture of pictures) picture.loading = "eager";
    return Promise.allSettled(pictures.map((picture) => picture.decode()));
  };
  addEventListener("beforeprint", load);

  const button = document.createElement("button");
  button.type = "button";
  button.textContent = "Print this page";
  button.addEventListener("click", async () => {
    await load();
    print();
  });
  document.querySelector(".edition")?.append(" ", button);
}
