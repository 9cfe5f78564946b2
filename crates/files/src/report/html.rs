//! The frame of the page, tables and figures. Whatever comes from a file goes through [`escape`]; there are
//! no scripts and no addresses.

pub(crate) use crate::picture::svg::escape;

/// Light and dark, narrow and wide, on a screen and on paper; texts have a contrast of 4.5 to 1 at least.
const STYLE: &str = "\
:root{color-scheme:light dark;--ground:#fff;--text:#1c2024;--faint:#59636e;--line:#d0d7de;--panel:#f6f8fa;--good:#116329;--bad:#a40e26;--note:#7d4e00}\
@media (prefers-color-scheme:dark){:root{--ground:#15181c;--text:#e6e9ec;--faint:#a0a9b3;--line:#3a424b;--panel:#1e2329;--good:#56d364;--bad:#ff8f88;--note:#e3b341}\
.plot svg{filter:invert(.92) hue-rotate(180deg)}}\
*{box-sizing:border-box}\
body{margin:0 auto;max-width:60rem;padding:1.5rem 1rem 3rem;background:var(--ground);color:var(--text);font:16px/1.5 system-ui,'Segoe UI',Roboto,Helvetica,Arial,sans-serif}\
h1{font-size:1.7rem;line-height:1.2;margin:0 0 .3rem;overflow-wrap:anywhere}h2{font-size:1.2rem;margin:2.2rem 0 .6rem;padding-bottom:.2rem;border-bottom:1px solid var(--line)}\
h3{font-size:1rem;margin:1.2rem 0 .3rem}p{margin:.5rem 0;overflow-wrap:anywhere}\
.faint{color:var(--faint)}.good{color:var(--good)}.bad{color:var(--bad)}.note{color:var(--note)}.status{font-weight:700}\
.scroll{overflow-x:auto}table{border-collapse:collapse;width:100%;font-size:.92rem}\
th,td{text-align:left;vertical-align:top;padding:.3rem .8rem .3rem 0;border-bottom:1px solid var(--line);overflow-wrap:break-word}\
th{font-weight:600}td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}tbody th{font-weight:400;color:var(--faint);width:34%}\
code,pre{font:.88em ui-monospace,SFMono-Regular,Consolas,'DejaVu Sans Mono',monospace}code{overflow-wrap:anywhere}\
pre{background:var(--panel);border:1px solid var(--line);border-radius:6px;padding:.7rem .9rem;white-space:pre-wrap;overflow-wrap:anywhere}\
figure{margin:1rem 0}figure img{display:block;max-width:100%;height:auto;background:#fff;border-radius:6px}figcaption{color:var(--faint);font-size:.88rem;margin-top:.3rem}\
.plot svg{display:block;width:100%;min-width:38rem;height:auto;border-radius:6px}\
.chosen table{table-layout:fixed}.chosen th:first-child{width:20%}.chosen th:nth-child(2){width:26%}.chosen td{overflow-wrap:anywhere}\
details{margin:.8rem 0}summary{cursor:pointer;padding:.3rem 0}\
.message{border-left:4px solid var(--note);background:var(--panel);padding:.5rem .9rem;margin:.7rem 0;border-radius:0 6px 6px 0}.message.error{border-color:var(--bad)}\
@media print{:root{--ground:#fff;--text:#000;--faint:#444;--line:#bbb;--panel:#fff;--good:#000;--bad:#000;--note:#000}body{max-width:none;padding:0;font-size:10.5pt}\
.plot svg{filter:none;min-width:0}.scroll{overflow:visible}figure,.message,tr{break-inside:avoid}h2,h3{break-after:avoid}}";

/// The whole file.
pub(crate) fn page(title: &str, body: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\">\n\
         <title>{}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n",
        escape(title)
    )
}

/// A section with its heading; none without contents. `body` is HTML.
pub(crate) fn section(title: &str, body: &str) -> String {
    if body.is_empty() { String::new() } else { format!("<section>\n<h2>{}</h2>\n{body}</section>\n", escape(title)) }
}

/// Names and values, texts.
pub(crate) fn facts(rows: &[(String, String)]) -> String {
    let rows: String =
        rows.iter().map(|(name, value)| format!("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escape(name), escape(value))).collect();
    if rows.is_empty() { rows } else { format!("<div class=\"scroll\"><table><tbody>\n{rows}</tbody></table></div>\n") }
}

/// A table of texts with its head; columns from `numbers` on stand at the right.
pub(crate) fn table(head: &[&str], rows: &[Vec<String>], numbers: usize) -> String {
    let class = |column: usize| if column >= numbers { " class=\"n\"" } else { "" };
    let head: String = head.iter().enumerate().map(|(k, cell)| format!("<th scope=\"col\"{}>{}</th>", class(k), escape(cell))).collect();
    let row = |cells: &Vec<String>| -> String {
        let cells: String = cells.iter().enumerate().map(|(k, cell)| format!("<td{}>{}</td>", class(k), escape(cell))).collect();
        format!("<tr>{cells}</tr>\n")
    };
    if rows.is_empty() {
        return String::new();
    }
    format!(
        "<div class=\"scroll\"><table><thead><tr>{head}</tr></thead><tbody>\n{}</tbody></table></div>\n",
        rows.iter().map(row).collect::<String>()
    )
}

/// A paragraph of text.
pub(crate) fn paragraph(text: &str) -> String {
    format!("<p>{}</p>\n", escape(text))
}

/// A plot: the text of an SVG file within the page.
pub(crate) fn plot(svg: &str, reported: &str, caption: &str) -> String {
    let inner = svg.find("<svg").map_or("", |start| &svg[start..]);
    // Within a page its namespace is known; what is not in it must not look like an address.
    let inner = inner.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1);
    let inner = inner.replacen("<svg", &format!("<svg role=\"img\" aria-label=\"{}\"", escape(reported)), 1);
    format!(
        "<figure class=\"plot\"><div class=\"scroll\" tabindex=\"0\">\n{inner}</div><figcaption>{}</figcaption></figure>\n",
        escape(caption)
    )
}
