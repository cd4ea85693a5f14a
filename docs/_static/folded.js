// A link to a place that is folded away opens it, and so does one to a heading below which all is folded.
{
  const open = () => {
    const place = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!place) return;
    let folded = place.querySelector(":scope > :is(h2, h3) + details") ?? place.closest("details");
    for (; folded; folded = folded.parentElement.closest("details")) folded.open = true;
    place.scrollIntoView();
  };
  if (location.hash) open();
  addEventListener("hashchange", open);
}
