// Any two columns against each other: a point a realisation, coloured by scenario; under the pointer it tells what it is.
(function () {
    var data = JSON.parse(document.getElementById('columns').textContent);
    var place = document.getElementById('explorer');
    var colors = ['#2b5c8a', '#d98b2b', '#5b9a5b', '#a83c3c', '#7a5a9e', '#555555'];
    var space = 'http://www.w3.org/2000/svg', width = 900, height = 520, left = 90, right = 20, top = 16, foot = 60;
    function choice(id, chosen) {
        var select = document.getElementById(id);
        data.columns.forEach(function (column) {
            select.add(new Option(column.name, column.name, false, column.name === chosen));
        });
        select.addEventListener('change', draw);
        return select;
    }
    function node(parent, kind, attributes, text) {
        var made = document.createElementNS(space, kind);
        Object.keys(attributes).forEach(function (key) { made.setAttribute(key, attributes[key]); });
        if (text !== undefined) made.textContent = text;
        parent.appendChild(made);
        return made;
    }
    // Round numbers, some five of them, from below the least to above the greatest.
    function ticks(values) {
        var low = Math.min.apply(null, values), high = Math.max.apply(null, values);
        if (low === high) { var room = Math.abs(low) * 0.01 || 1; low -= room; high += room; }
        var rough = (high - low) / 5, power = Math.pow(10, Math.floor(Math.log10(rough)));
        var step = [1, 2, 5, 10].find(function (times) { return times * power >= rough; }) * power;
        var found = [];
        for (var at = Math.floor(low / step); at <= Math.ceil(high / step); at++) found.push(at * step);
        return found;
    }
    function shown(value) {
        var size = Math.abs(value);
        return size >= 1e4 || (size > 0 && size < 1e-3) ? value.toExponential(2) : String(+value.toPrecision(6));
    }
    function draw() {
        var columns = [x, y].map(function (select) { return data.columns[select.selectedIndex]; });
        var points = data.names.map(function (name, at) {
            return { name: name, at: columns.map(function (column) { return column.values[at]; }), scenario: data.scenario[at] };
        }).filter(function (point) { return point.at[0] !== null && point.at[1] !== null; });
        place.textContent = '';
        var svg = node(place, 'svg', { viewBox: '0 0 ' + width + ' ' + height, width: width, role: 'img', 'font-size': 13, fill: '#333' });
        if (!points.length) { node(svg, 'text', { x: left, y: 40 }, 'no realisation has both'); return; }
        var marks = [0, 1].map(function (axis) { return ticks(points.map(function (point) { return point.at[axis]; })); });
        function scale(axis, value) {
            var all = marks[axis], part = (value - all[0]) / (all[all.length - 1] - all[0]);
            return axis ? height - foot - part * (height - foot - top) : left + part * (width - left - right);
        }
        marks[0].forEach(function (value) {
            var at = scale(0, value);
            node(svg, 'line', { x1: at, x2: at, y1: top, y2: height - foot, stroke: '#ddd' });
            node(svg, 'text', { x: at, y: height - foot + 20, 'text-anchor': 'middle' }, shown(value));
        });
        marks[1].forEach(function (value) {
            var at = scale(1, value);
            node(svg, 'line', { x1: left, x2: width - right, y1: at, y2: at, stroke: '#ddd' });
            node(svg, 'text', { x: left - 8, y: at + 4, 'text-anchor': 'end' }, shown(value));
        });
        node(svg, 'text', { x: (left + width - right) / 2, y: height - 14, 'text-anchor': 'middle' }, columns[0].name);
        var middle = (top + height - foot) / 2;
        node(svg, 'text', { x: 14, y: middle, 'text-anchor': 'middle', transform: 'rotate(-90 14 ' + middle + ')' }, columns[1].name);
        points.forEach(function (point) {
            var color = colors[point.scenario % colors.length];
            var dot = node(svg, 'circle', {
                cx: scale(0, point.at[0]), cy: scale(1, point.at[1]), r: 4, fill: color, 'fill-opacity': 0.65, stroke: color
            });
            node(dot, 'title', {}, point.name + ': ' + point.at.map(shown).join(', '));
        });
        if (data.scenarios.length > 1) data.scenarios.forEach(function (name, at) {
            node(svg, 'circle', { cx: left + 14, cy: top + 14 + 20 * at, r: 5, fill: colors[at % colors.length] });
            node(svg, 'text', { x: left + 26, y: top + 18 + 20 * at }, name);
        });
    }
    var x = choice('explorer-x', data.x), y = choice('explorer-y', data.y);
    draw();
})();
