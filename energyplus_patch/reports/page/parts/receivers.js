// The table of all receivers: sorted, filtered, and a name chooses its receiver.

const COLUMNS = [["Receiver", 0], ["Area, m\u00b2", 3], ["Azimuth, \u00b0", 1], ["Tilt, \u00b0", 1], ["Mean sunlit fraction", 4],
  ["Beam per m\u00b2, kWh", 1], ["Total beam, kWh", 1]];
const MOST_ROWS = 500;
const MOST_ROWS_ON_PAPER = 100;

class ReceiverTable {
  constructor(table, filter, shown, onChoose) {
    Object.assign(this, {table, filter, shown, onChoose, sorted: 5, ascending: false});
    const head = table.tHead.rows[0];
    COLUMNS.forEach(([title], column) => {
      const cell = document.createElement("th");
      cell.scope = "col";
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = title;
      button.addEventListener("click", () => this.sort(column));
      cell.append(button);
      head.append(cell);
    });
    filter.addEventListener("input", () => this.fill());
    this.fill();
  }

  valueOf(receiver, column) {
    return column === 0 ? content.names[receiver] : content.receivers[receiver][column - 1];
  }

  sort(column) {
    this.ascending = this.sorted === column ? !this.ascending : column === 0;
    this.sorted = column;
    this.fill();
  }

  fill() {
    const wanted = this.filter.value.trim().toUpperCase();
    const rows = content.receivers.map((_, i) => i)
      .filter((i) => content.names[i].toUpperCase().includes(wanted));
    const sign = this.ascending ? 1 : -1;
    rows.sort((a, b) => {
      const [first, second] = [this.valueOf(a, this.sorted), this.valueOf(b, this.sorted)];
      return sign * (typeof first === "string" ? first.localeCompare(second) : first - second);
    });
    [...this.table.tHead.rows[0].cells].forEach((cell, column) => {
      if (column !== this.sorted) cell.removeAttribute("aria-sort");
      else cell.setAttribute("aria-sort", this.ascending ? "ascending" : "descending");
    });
    const body = this.table.tBodies[0];
    const most = printing ? MOST_ROWS_ON_PAPER : MOST_ROWS;
    body.replaceChildren(...rows.slice(0, most).map((receiver) => this.row(receiver)));
    this.shown.textContent = rows.length > most ? `first ${most} of ${rows.length}`
      : `${rows.length} of ${content.receiverCount}`;
    this.mark(this.chosen);
  }

  row(receiver) {
    const row = document.createElement("tr");
    row.dataset.receiver = receiver;
    COLUMNS.forEach(([, digits], column) => {
      const cell = row.insertCell();
      if (column > 0) {
        cell.textContent = numberText(this.valueOf(receiver, column), digits);
        return;
      }
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = content.names[receiver];
      button.addEventListener("click", () => this.onChoose(receiver));
      cell.append(button);
    });
    return row;
  }

  mark(receiver) {
    this.chosen = receiver;
    for (const row of this.table.tBodies[0].rows) {
      if (Number(row.dataset.receiver) === receiver) row.setAttribute("aria-current", "true");
      else row.removeAttribute("aria-current");
    }
  }
}
