// What a search finds first: of entries of the index, the page that explains the term, then the glossary.
// The other numbers are Sphinx's own.
var Scorer = {
  score: ([page, , , , score, , kind]) =>
    kind === "index" && page !== "glossary" ? score + 1 : score,
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
