"use strict";
(function () {
    const data = JSON.parse(document.getElementById("data").textContent);
    const table = document.getElementById("table");
    const search = document.getElementById("search");
    const light = document.getElementById("light");
    const factor = document.getElementById("factor");
    const best = document.getElementById("best");
    const words = [["row", "row"], ["factor", "varied"], ["scene", "scene"], ["light", "light"], ["kind", "kind"]];
    const last = [["fronts", "fronts"], ["state", "state"], ["reason", "reason"]];
    const columns = words.map(([key, title]) => ({ title, text: true, of: (row) => row[key] }))
        .concat(data.columns.map((column, i) => ({ title: column, of: (row) => row.figures[i] })))
        .concat(last.map(([key, title]) => ({ title, text: true, of: (row) => row[key] })));
    const order = { column: 0, down: false, natural: true };

    function element(name, text, parent) {
        const made = document.createElement(name);
        if (text !== undefined) made.textContent = text;
        if (parent) parent.appendChild(made);
        return made;
    }

    function shown(value, column) {
        if (value === null || value === undefined || value === "") return "";
        if (column.text) return value;
        return Math.abs(value) >= 1000 ? Math.round(value).toLocaleString("en") : String(Number(value.toPrecision(3)));
    }

    function fill(select, key) {
        for (const value of new Set(data.rows.map((row) => row[key]))) element("option", value, select).value = value;
    }

    function matches(row) {
        const text = [row.row, row.settings, row.reason, row.state, row.error, row.kind, row.scene].join(" ");
        return text.toLowerCase().includes(search.value.toLowerCase()) && (!light.value || row.light === light.value) &&
            (!factor.value || row.factor === factor.value) && (!best.checked || row.fronts !== "");
    }

    // What has no value comes last, whichever way the others go.
    function compare(a, b) {
        const column = columns[order.column];
        const x = column.of(a), y = column.of(b);
        const none = (v) => v === null || v === undefined || v === "";
        if (none(x) || none(y)) return none(x) - none(y);
        const way = order.down ? -1 : 1;
        return column.text ? way * String(x).localeCompare(String(y)) : way * (x - y);
    }

    function picture(parent, source, caption) {
        const figure = element("figure", undefined, parent);
        if (source) element("img", undefined, figure).src = source;
        else element("p", "left out", figure);
        element("figcaption", caption, figure);
    }

    function choose(row) {
        const panel = document.getElementById("pictures");
        panel.replaceChildren();
        panel.hidden = false;
        panel.scrollIntoView({ block: "nearest" });
        element("h3", row.light ? row.row + ", " + row.light : row.row, panel);
        const text = row.settings === "" ? "nothing set" : row.settings;
        element("p", row.error ? "Failed: " + row.error : text, panel);
        if (row.light && row.pictures) {
            picture(panel, row.pictures.render, "render");
            picture(panel, row.pictures.shown, "visibility");
            picture(panel, data.truths[row.truth], "truth");
            picture(panel, row.pictures.error, "error");
        } else {
            element("p", "This row's pictures were left out to keep the page small.", panel);
        }
        for (const chosen of document.querySelectorAll(".chosen")) chosen.classList.remove("chosen");
        for (const plot of document.querySelectorAll("[data-light]"))
            if (plot.dataset.light === row.light && plot.dataset.scene === String(row.scene_index))
                for (const dot of plot.querySelectorAll('[data-row="' + row.index + '"]')) dot.classList.add("chosen");
    }

    function draw() {
        const body = table.tBodies[0];
        body.replaceChildren();
        const rows = data.rows.filter(matches);
        if (!order.natural) rows.sort(compare);
        for (const row of rows) {
            const line = element("tr", undefined, body);
            if (row.error) line.classList.add("failed");
            if (row.fronts !== "") line.classList.add("best");
            for (const column of columns) {
                const cell = element("td", shown(column.of(row), column), line);
                if (column.text) cell.className = "words";
            }
            line.addEventListener("click", () => {
                choose(row);
                line.classList.add("chosen");
            });
        }
        document.getElementById("count").textContent = rows.length + " of " + data.rows.length + " rows";
    }

    const head = element("tr", undefined, table.tHead);
    columns.forEach((column, i) => {
        const cell = element("th", column.title, head);
        cell.addEventListener("click", () => {
            order.down = !order.natural && order.column === i && !order.down;
            order.column = i;
            order.natural = false;
            for (const other of head.cells) other.classList.remove("up", "down");
            cell.classList.add(order.down ? "down" : "up");
            draw();
        });
    });
    fill(light, "light");
    fill(factor, "factor");
    for (const control of [search, light, factor, best]) control.addEventListener("input", draw);
    for (const dot of document.querySelectorAll(".dot")) {
        const plot = dot.closest("[data-light]");
        dot.addEventListener("click", () => {
            const found = data.rows.find((row) => row.light === plot.dataset.light &&
                String(row.scene_index) === plot.dataset.scene && String(row.index) === dot.dataset.row);
            if (found) choose(found);
        });
    }
    draw();
})();
