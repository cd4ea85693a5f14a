// Sphinx marks the words that a search has found. The titles of drawings aren't drawn, so nothing in them can be marked.
for (const text of document.querySelectorAll("svg title, svg desc, svg style")) text.classList.add("nohighlight");
