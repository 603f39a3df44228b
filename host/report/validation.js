// The page of a validation: for each comparison its figures with their verdicts, and its curves.

function comparisonPart(main, comparison) {
  add(main, "h2", comparison.name);
  add(main, "p", `${comparison.what}. ${comparison.source ? "Source: " + comparison.source + ". " : ""}` +
                 (comparison.missing ? `Not made: ${comparison.missing}.` : `${comparison.cost}, on ${comparison.backend}.`));
  if (comparison.findings.length > 0)
    table(main, [["figure", false], ["expected", true], ["got", true], ["unit", false], ["verdict", false], ["source", false], ["remark", false]],
          comparison.findings.map(f => [f.figure, f.expected, f.error > 0 ? within(f.got, f.error) : short(f.got), f.unit, f.verdict, f.source, f.remark]));
  const grid = add(main, "div", null, "charts");
  comparison.charts.forEach(c => chart(grid, {
    title: c.title, note: c.note, x: {label: c.x, pad: true}, y: {label: c.y, zero: false},
    series: c.curves.map((s, i) => ({name: s.name, points: s.points, line: s.line, dots: s.dots, colour: colour(i, c.curves.length),
                                     dash: i > 1 ? "6 4" : null})),
  }));
}

function validationPage(main, report) {
  report.comparisons.forEach(c => comparisonPart(main, c));
}
